#pragma once

#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/ladder/refining.hpp"
#include "studies/orders/verdict.hpp"
#include "studies/runs/execution.hpp"
#include "studies/runs/studied_solver.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// One norm, or value, along a ladder.
struct LadderNorm {
    Measure norm;
    /// Observed order against the rung before, none of rounding, and what each rung shows; empty of
    /// a value.
    std::vector<std::optional<double>> orders;
    std::vector<RowVerdict> verdicts;
    std::optional<double> rounding;         ///< every error is, or may be, rounding below this
    std::vector<OrderInterval> predictions; ///< of the fits of [orders], 95 %; empty without them
    std::vector<std::string> remarks;       ///< what the orders mean, in sentences
};

/// The record of a ladder study.
struct LadderResult {
    std::vector<RungResult> rungs;
    std::vector<LadderNorm> norms = {};
    std::string quadrature_remark =
        {};                            ///< rungs whose errors quadrature leaves uncertain; or empty
    std::string reference_remark = {}; ///< rungs too close to the reference; empty without such
    std::optional<DataAnalysis> analysis = {}; ///< where LadderBlock::says_orders, or of values
    std::optional<Refined> refined = {};       ///< why no further; with `until`
};

/// The runs that the block asks for.
Series series_of(const LadderBlock& block, const Method& method);

/// What the finished runs of a ladder show. orders: a grid of the same solver up to the same final
/// time, whose models then judge the rungs and predict them; or null.
LadderResult analyse_ladder(const LadderBlock& block, const Method& method,
                            std::vector<RungResult> rungs, const StudiedSolver& solver,
                            const OrdersResult* orders = nullptr);

/// Makes the runs of the block, and those that its `until` adds.
LadderResult make_runs(const LadderBlock& block, const Method& method, const RunCall& run,
                       const Execution& execution);

/// Runs every rung, the others also after one that failed, and analyses them.
LadderResult run_ladder(const LadderBlock& block, const Method& method, const StudiedSolver& solver,
                        const OrdersResult* orders = nullptr, const Execution& execution = {});

} // namespace tvbeam
