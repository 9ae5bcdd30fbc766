#pragma once

#include "mms/text/input_error.hpp"
#include "reports/files/output_file.hpp"
#include "studies/scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Where one report goes: nowhere, standard output (-), or a file.
class Destination {
public:
    explicit Destination(const std::string& name) : standard_output_(name == "-") {
        if (!name.empty() && !standard_output_)
            file_.emplace(name);
    }
    [[nodiscard]] bool wanted() const { return standard_output_ || file_; }
    [[nodiscard]] bool standard_output() const { return standard_output_; }
    void write(const LongText& text) {
        if (file_)
            file_->commit(text);
        else
            write_standard_output(text);
    }

private:
    bool standard_output_;
    std::optional<OutputFile> file_;
};

/// Opens what results will go to, before anything runs: a place that cannot be written is bad
/// input.
template <typename Open>
auto opened(const Open& open) {
    try {
        return open();
    } catch (const OutputError& error) {
        throw InputError({}, error.what());
    }
}

/// "": nowhere; "-": standard output; otherwise a file, which is opened. Throws InputError.
Destination destination(const std::string& name);

/// Whether two names are of one file, or both of standard output; an empty one is of nothing.
/// Devices and pipes hold nothing that could be lost.
bool same_place(const std::string& first, const std::string& second);

/// Throws InputError where two options name one place.
void require_apart(const std::string& first, const std::string& file, const std::string& second,
                   const std::string& other);

/// Throws InputError where a report would take the place of a file that the command reads.
void require_no_input(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs);

/// The files that a scene consists of.
std::vector<std::string> files_of(const Scene& scene);

} // namespace tvbeam
