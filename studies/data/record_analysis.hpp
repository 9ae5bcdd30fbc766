#pragma once

#include "studies/data/csv_records.hpp"
#include "studies/orders/convergence_fit.hpp"
#include "studies/orders/extrapolation.hpp"
#include "studies/orders/observed_order.hpp"
#include "studies/orders/two_term_fit.hpp"
#include "studies/orders/verdict.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What a computed number says of its own limit as h goes to zero, where no error is known.
struct ValueAnalysis {
    std::vector<GridValue> grids;        ///< coarse to fine
    std::optional<Extrapolation> finest; ///< of the three finest different widths
    std::string no_extrapolation;        ///< why there is none
    std::optional<LimitFit> limit;       ///< with four grids or more
};

ValueAnalysis analyse_values(std::vector<GridValue> grids);

/// What the errors of any solver show: of a grid, which has three different h and three different
/// Δt or more and at least 0.7 of all their pairs, the two-term model; of a ladder, pairwise
/// orders, verdicts and a power law.
struct RecordAnalysis {
    /// A grid's as they were given; a ladder's from coarse to fine by h, then by Δt, equal widths
    /// in the order given.
    std::vector<Refinement> records;
    std::vector<std::optional<double>> orders; ///< of a ladder; empty for a grid
    std::optional<LadderVerdict> verdict;      ///< of a ladder
    /// Of a ladder: over its asymptotic window, or over all records. Rows past the window that
    /// stand on a floor belong to it where the fit finds one.
    std::optional<PowerLawFit> power_law;
    std::string no_power_law;            ///< why there is none, for a ladder without
    std::optional<TwoTermFit> two_term;  ///< of a grid
    std::optional<ValueAnalysis> values; ///< where there are values for errors; then nothing else
};

RecordAnalysis analyse(std::vector<Refinement> records);
RecordAnalysis analyse(RecordFile file);

} // namespace tvbeam
