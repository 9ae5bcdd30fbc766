#pragma once

#include "studies/stress/stress_tally.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tvbeam {

/// The judged cases of a study, as many as there may be: in memory or, where they are many, on the
/// disk. Copies share them.
class StressCases {
public:
    StressCases();

    /// The case of an index, in any order; those between may be missing. For one thread at a time.
    /// Throws std::runtime_error where the disk is full.
    void set(std::size_t index, const StressCase& one);
    void add(const StressCase& one) { set(slots(), one); }

    [[nodiscard]] std::size_t size() const; ///< that are there
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] std::size_t count(Outcome outcome) const {
        return tallies().all().count(outcome);
    }
    [[nodiscard]] const StressTallies& tallies() const;
    /// Of the first that failed; empty: none did.
    [[nodiscard]] std::string first_failure() const;

    /// The one of an index, which must be there.
    [[nodiscard]] StressCase at(std::size_t index) const;

    /// All that are there, in the order of their indices.
    void visit(const std::function<void(const StressCase&)>& visitor) const;

private:
    struct Kept;
    [[nodiscard]] std::size_t slots() const;

    std::shared_ptr<Kept> kept_;
};

} // namespace tvbeam
