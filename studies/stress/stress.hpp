#pragma once

#include "studies/runs/execution.hpp"
#include "studies/stress/contraction_map.hpp"
#include "studies/stress/roundoff.hpp"
#include "studies/stress/stress_case.hpp"

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
    bool interrupted = false;

    [[nodiscard]] std::int64_t count(Outcome outcome) const;
    [[nodiscard]] bool failed() const { return interrupted || count(Outcome::failed) > 0; }

    /// What [expect.stress] may hold bands for.
    [[nodiscard]] std::map<std::string, double> figures() const;
};

/// Judges all cases, and then measures what else the block asks for. Of an interrupted study the
/// cases that were judged.
StressResult run_stress(const StressBlock& block, const Execution& execution = {});

/// Elements times steps of a case; what it costs, about.
double work_of(const StressParameters& parameters);

} // namespace tvbeam
