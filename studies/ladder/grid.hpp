#pragma once

#include "studies/orders/two_term_fit.hpp"
#include "studies/runs/rung.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The orders of one norm, from a grid of runs.
struct NormOrders {
    std::string norm; ///< the norm itself, not its square
    TwoTermFit fit;
};

/// The constants C of Corollary 2.2 over the grid: corollary ≤ C (h² + Δt²).
struct CorollaryConstants {
    double least = 0.0;
    double greatest = 0.0;
    double finest = 0.0; ///< of the run with the smallest h² + Δt²
};

/// The record of an [orders] study: every mesh with every step.
struct OrdersResult {
    std::vector<RungResult> runs;
    std::vector<NormOrders> norms;
    std::optional<CorollaryConstants>
        corollary; ///< if `corollary` was asked for and some run has an error

    /// The model of a norm, or of the root of a squared one; null when the grid has none that
    /// holds.
    [[nodiscard]] const TwoTermModel* model_of(const Norm& norm) const;
};

/// Runs the grid and fits the model to each norm.
OrdersResult run_orders(const Scene& scene, const OrdersBlock& block, const ProblemData& data,
                        const Execution& execution = {});

} // namespace tvbeam
