#pragma once

#include "studies/scene/next_level.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/scene/until.hpp"

#include <optional>
#include <vector>

namespace tvbeam {

/// The block [orders]: a grid of runs, every mesh with every step.
struct OrdersBlock {
    double final_time = 0.0;
    std::vector<Rung> grid; ///< elements change fastest
    /// None is a square, but for what has no norm of its own; then values.
    std::vector<Measure> norms;
    std::optional<Until> until = {};
    /// Behind the meshes, and behind the steps, that there are. Only with `until`.
    NextLevel next_mesh = {};
    NextLevel next_step = {};
};

/// Reads the block: final_time, elements, dt (a list of its own), norms and, of solvers that
/// compute any, values (at least one of all); until: order, limit, seconds, runs (Until). Throws
/// InputError where a value is missing or breaks its rule.
OrdersBlock read_orders(TableReader& table, const SolverKeys& keys);

} // namespace tvbeam
