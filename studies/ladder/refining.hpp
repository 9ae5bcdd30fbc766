#pragma once

#include "studies/data/data_analysis.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/runs/execution.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What the runs of a ladder show of each measure, a column a measure: orders with 95 % intervals,
/// of a square those of the norm itself; limits of values.
DataAnalysis analysis_of(const Series& series, const std::vector<RungResult>& rungs);

/// The levels that `until` may add to a ladder.
std::vector<Rung> added_levels(const LadderBlock& ladder);

/// The norms and values of a ladder's levels, from coarse to fine, of which the block does not yet
/// know what it wants. Known is what has an interval as narrow as that, of at least
/// least_known_levels levels that show something of it, with its middle in the interval that the
/// levels without the finest of these give, however wide that may be: two intervals that agree.
/// Nothing is known of an error that vanishes_at_the_finest().
std::vector<std::string> not_known(const Until& until, const Series& series,
                                   const std::vector<RungResult>& rungs);

/// Adds levels to a series, and their runs to its results, until what the block wants is known or
/// its budget is spent. Seconds are those of the runs, all of them; the next is taken to need as
/// much more than the last one as that did than the one before.
Refined refine(const LadderBlock& block, Series& series, std::vector<RungResult>& rungs,
               const RunCall& run, const Execution& execution);

} // namespace tvbeam
