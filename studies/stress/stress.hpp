#pragma once

#include "studies/runs/execution.hpp"
#include "studies/stress/contraction_map.hpp"
#include "studies/stress/roundoff.hpp"
#include "studies/stress/stress_cases.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The record of a [stress] study.
struct StressResult {
    StressCases cases; ///< of all sweeps in turn
    std::optional<ContractionMap> contraction;
    std::optional<RoundOffTable> roundoff;
    bool interrupted = false;
    /// Of each part that is not whole, as "stress.contraction", how many of how many are there.
    struct Reached {
        std::string study;
        std::size_t there = 0;
        std::size_t all = 0;
    };
    std::vector<Reached> reached = {};

    [[nodiscard]] bool failed() const { return interrupted || cases.count(Outcome::failed) > 0; }

    /// What [expect.stress] may hold bands for.
    [[nodiscard]] std::map<std::string, double> figures() const;
};

/// Judges all cases, and then measures what else the block asks for. Of an interrupted study the
/// cases that were judged.
StressResult run_stress(const StressBlock& block, const Execution& execution = {});

/// What it is made of, apart from each other: the cases, as "stress" (StressCase); rows of the
/// contraction map, as "stress.contraction" (ContractionRow); and rows of the round-off table, as
/// "stress.roundoff" (RoundOffRow). The block must outlive them.
std::vector<Parts> parts_of(const StressBlock& block);

} // namespace tvbeam
