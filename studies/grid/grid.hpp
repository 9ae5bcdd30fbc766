#pragma once

#include "studies/grid/grid_limit.hpp"
#include "studies/grid/orders_block.hpp"
#include "studies/orders/two_term_fit.hpp"
#include "studies/runs/execution.hpp"
#include "studies/runs/studied_solver.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The orders of one norm, from a grid of runs.
struct NormOrders {
    std::string norm; ///< the norm itself, not its square
    TwoTermFit fit;
    std::optional<double> rounding = {}; ///< of the measure: every error is, or may be, below this
};

/// The constants C of a theorem (Measure::theorem) over the grid: error ≤ C (h² + Δt²).
struct TheoremConstants {
    std::string theorem; ///< e.g. "Corollary 2.2"
    double least = 0.0;
    double greatest = 0.0;
    double finest = 0.0; ///< of the run with the smallest h² + Δt²
};

/// The record of an [orders] study: every mesh with every step.
struct OrdersResult {
    std::vector<RungResult> runs;
    std::vector<NormOrders> norms;
    std::vector<GridLimit> values = {}; ///< behind the norms in the block's list
    /// If a measure that a theorem bounds was asked for and some run has an error.
    std::optional<TheoremConstants> corollary;
    std::optional<Refined> refined = {}; ///< why no further; with `until`
    std::string reference_remark = {};   ///< grid_reference_remark(); empty without a reference

    /// The fit of a norm, or of the root of a squared one; null where the grid does not determine
    /// both orders, and so predicts nothing.
    [[nodiscard]] const TwoTermFit* fit_of(const Measure& norm) const;
};

/// The runs that the block asks for.
Series series_of(const OrdersBlock& block, const Method& method);

/// vanishes_at_the_finest() of the errors of a grid; what is zero to its digits does not.
bool vanishes_at_the_finest(const std::vector<RungResult>& runs, std::size_t k);

/// What the runs of a grid show of the measures; without them. reference: of StudiedSolver.
OrdersResult analyse_grid(const std::vector<RungResult>& runs, const std::vector<Measure>& measures,
                          const std::optional<ReferenceBlock>& reference = std::nullopt);

/// Runs the grid, with what its `until` adds, and fits the model to each norm.
OrdersResult run_orders(const OrdersBlock& block, const Method& method, const StudiedSolver& solver,
                        const Execution& execution = {});

} // namespace tvbeam
