#pragma once

#include "reports/command_line/commands/destination.hpp"
#include "reports/files/baseline.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What --record names: nowhere, standard output, or a file with a baseline, of which the entries
/// of other names stay.
class Record {
public:
    /// Before anything runs. Throws InputError where nothing can be written there, or something
    /// else than a baseline stands there.
    explicit Record(const std::string& file);

    [[nodiscard]] bool wanted() const { return destination_.wanted(); }
    [[nodiscard]] bool standard_output() const { return destination_.standard_output(); }

    /// As Baseline::require_room(), before anything runs.
    void require_room(const BaselineEntry& entry) const {
        if (earlier_)
            earlier_->require_room(entry);
    }

    /// Of several programs that record in one file none loses what another has written meanwhile.
    void write(const std::vector<BaselineEntry>& entries);

private:
    std::string file_; ///< empty: none
    Destination destination_;
    std::optional<Baseline> earlier_;
};

} // namespace tvbeam
