#pragma once

#include "studies/contraction_map.hpp"
#include "studies/roundoff.hpp"
#include "studies/stress_case.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The record of a [stress] study.
struct StressResult {
    std::vector<StressCase> cases; ///< of all sweeps in turn
    std::optional<ContractionMap> contraction;
    std::optional<RoundOffTable> roundoff;

    [[nodiscard]] std::int64_t count(Outcome outcome) const;
    [[nodiscard]] bool failed() const { return count(Outcome::failed) > 0; }

    /// What [expect.stress] may hold bands for.
    [[nodiscard]] std::map<std::string, double> figures() const;
};

StressResult run_stress(const StressBlock& block);

} // namespace tvbeam
