#pragma once

#include "studies/orders/ladder_order.hpp"
#include "studies/orders/observed_order.hpp"
#include "studies/orders/two_term_fit.hpp"
#include "studies/orders/verdict.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What the errors of any solver show: of a grid, which has three different h and three different
/// Δt or more and at least 0.7 of all their pairs, the two-term model; of a ladder, orders from row
/// to row, verdicts and the order along it.
struct RecordAnalysis {
    /// A grid's as they were given; a ladder's from coarse to fine by h, then by Δt, equal widths
    /// in the order given.
    std::vector<Refinement> records;
    std::vector<std::optional<double>> orders; ///< of a ladder (LadderVerdict); empty for a grid
    std::optional<LadderVerdict> verdict;      ///< of a ladder
    LadderOrder along;                         ///< of a ladder
    std::optional<TwoTermFit> two_term;        ///< of a grid
};

/// sigma: standard deviations of the errors, one a record; empty where they are not known.
/// rounded: they are what rounding to the digits printed makes.
RecordAnalysis analyse(std::vector<Refinement> records, const std::vector<double>& sigma = {},
                       bool rounded = false);

} // namespace tvbeam
