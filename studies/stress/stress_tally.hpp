#pragma once

#include "studies/stress/stress_case.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// The name of a kind of initial data, as a scene gives it.
std::string name_of(InitialData initial);

/// The regimes that a case belongs to, one a list of parameters: "alpha > 10", "time bdf2".
std::vector<std::string> regimes_of(const StressParameters& parameters);

/// A check of a case, by name, as StressChecks has it; of contact only where there are stops.
struct NamedCheck {
    std::string name;
    std::string words; ///< in a report; empty: not there
    std::optional<double> (*of)(const StressCase& one);
};
const std::vector<NamedCheck>& stress_checks();

/// What cases found, in any order: of NaNs and numbers a NaN is the extreme.
class StressTally {
public:
    void add(const StressCase& one);

    [[nodiscard]] std::size_t count(Outcome outcome) const;
    /// By what stands in [expect.stress]: "certified" and the like, "CHECK.count" (how many cases
    /// have it), "CHECK.least" and "CHECK.greatest".
    [[nodiscard]] std::map<std::string, double> figures() const;
    /// None: no case has the check.
    [[nodiscard]] std::optional<double> greatest(const std::string& check) const;

private:
    struct Range {
        std::size_t count = 0;
        double least = 0.0;
        double greatest = 0.0;
    };
    std::map<Outcome, std::size_t> outcomes_;
    std::vector<Range> checks_ = std::vector<Range>(stress_checks().size());
};

/// The tallies of all cases, and of those of each regime.
class StressTallies {
public:
    /// The place of its list of parameters, and the regime.
    using Key = std::pair<std::size_t, std::string>;

    void add(const StressCase& one);
    [[nodiscard]] const StressTally& all() const { return all_; }
    [[nodiscard]] const std::map<Key, StressTally>& regimes() const { return regimes_; }
    /// Of all cases as StressTally has them, and "REGIME.certified" and the like.
    [[nodiscard]] std::map<std::string, double> figures() const;

private:
    StressTally all_;
    std::map<Key, StressTally> regimes_;
};

} // namespace tvbeam
