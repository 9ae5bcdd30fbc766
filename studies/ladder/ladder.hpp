#pragma once

#include "studies/ladder/grid.hpp"
#include "studies/orders/verdict.hpp"
#include "studies/runs/rung.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// One norm along a ladder.
struct LadderNorm {
    Norm norm;
    std::vector<std::optional<double>> orders;      ///< observed order against the rung before
    std::vector<RowVerdict> verdicts;               ///< what each rung shows
    std::vector<std::optional<double>> predictions; ///< of the two-term model; empty without one
    std::vector<std::string> remarks;               ///< what the orders mean, in sentences
};

/// The record of a ladder study.
struct LadderResult {
    std::vector<RungResult> rungs;
    std::vector<LadderNorm> norms;
    std::string quadrature_remark; ///< rungs whose errors quadrature leaves uncertain; or empty
    std::string reference_remark;  ///< rungs too close to the reference; empty without such
};

/// Runs every rung of the scene's ladder, the others also after one that failed. orders: the grid
/// study of the same scene, whose models then judge the rungs and predict them; or null.
LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data,
                        const OrdersResult* orders, const Execution& execution = {});

} // namespace tvbeam
