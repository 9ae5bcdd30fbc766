#pragma once

#include "studies/scene/study_keys.hpp"

#include <vector>

namespace tvbeam {

/// The block [orders]: a grid of runs, every mesh with every step.
struct OrdersBlock {
    double final_time = 0.0;
    std::vector<Rung> grid;     ///< elements change fastest
    std::vector<Measure> norms; ///< none is a square, but for what has no norm of its own
};

/// Reads the block: final_time, elements, dt (a list of its own), norms (at least one). Throws
/// InputError where a value is missing or breaks its rule.
OrdersBlock read_orders(TableReader& table, const SolverKeys& keys);

} // namespace tvbeam
