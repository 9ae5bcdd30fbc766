#pragma once

#include "studies/grid/grid.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What of a grid is not yet as well known as the block wants it: "p of L2", "q of L2" for every
/// norm, "limit of drag" for every value. Known is what has an interval as narrow as that, of at
/// least least_known_levels meshes and steps with runs that show something of it, with its middle
/// in the interval that the grid without the finest such mesh (of p), without the finest such step
/// (of q), or without either (of a limit) gives. Nothing is known of an error that
/// vanishes_at_the_finest().
std::vector<std::string> not_known(const OrdersBlock& block, const std::vector<RungResult>& runs);

/// Adds lines (next_line.hpp) and their runs to a grid until what the block wants is known or its
/// budget is spent: first the cheaper one up to least_known_levels meshes and steps, then the one
/// that narrows the widest open interval most for its cost. That is forecast from the measured
/// seconds, where these are a budget, and else the work, so that another attempt adds the same. The
/// runs of a line are made side by side; they stand in `runs` as in OrdersBlock::grid.
Refined refine(const OrdersBlock& block, const Series& named, std::vector<RungResult>& runs,
               const RunCall& run, const Execution& execution);

} // namespace tvbeam
