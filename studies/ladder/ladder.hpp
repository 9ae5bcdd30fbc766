#pragma once

#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/orders/verdict.hpp"
#include "studies/runs/execution.hpp"
#include "studies/runs/studied_solver.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// One norm along a ladder.
struct LadderNorm {
    Measure norm;
    std::vector<std::optional<double>> orders; ///< observed order against the rung before
    std::vector<RowVerdict> verdicts;          ///< what each rung shows
    std::vector<OrderInterval> predictions; ///< of the fits of [orders], 95 %; empty without them
    std::vector<std::string> remarks;       ///< what the orders mean, in sentences
};

/// The record of a ladder study.
struct LadderResult {
    std::vector<RungResult> rungs;
    std::vector<LadderNorm> norms;
    std::string quadrature_remark; ///< rungs whose errors quadrature leaves uncertain; or empty
    std::string reference_remark;  ///< rungs too close to the reference; empty without such
};

/// The runs that the block asks for.
Series series_of(const LadderBlock& block, const Method& method);

/// What the finished runs of a ladder show. orders: a grid of the same solver up to the same final
/// time, whose models then judge the rungs and predict them; or null.
LadderResult analyse_ladder(const Series& series, std::vector<RungResult> rungs,
                            const StudiedSolver& solver, const OrdersResult* orders = nullptr);

/// Runs every rung, the others also after one that failed, and analyses them.
LadderResult run_ladder(const LadderBlock& block, const Method& method, const StudiedSolver& solver,
                        const OrdersResult* orders = nullptr, const Execution& execution = {});

} // namespace tvbeam
