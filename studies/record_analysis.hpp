#pragma once

#include "studies/convergence_fit.hpp"
#include "studies/observed_order.hpp"
#include "studies/two_term_fit.hpp"
#include "studies/verdict.hpp"

#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

/// What the errors of any solver show: of a grid, which has three different h and three different
/// Δt or more and repeats some of both, the two-term model; of a ladder, pairwise orders, verdicts
/// and a power law.
struct RecordAnalysis {
    std::vector<Refinement> records;
    std::vector<std::optional<double>> orders; ///< of a ladder; empty for a grid
    std::optional<LadderVerdict> verdict;      ///< of a ladder
    std::optional<PowerLawFit>
        power_law; ///< of a ladder: over its asymptotic window, or over all records
    std::optional<TwoTermFit> two_term; ///< of a grid
};

RecordAnalysis analyse(std::vector<Refinement> records);

} // namespace tvbeam
