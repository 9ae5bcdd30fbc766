#pragma once

#include "studies/gates/expectation.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <vector>

namespace tvbeam {

/// Reads [[expect.work_precision.sooner]]: how much sooner one scheme reaches an error than
/// another, by the medians of their times.
///
///     norm, error      one of the errors that the schemes are compared at: a power of ten, a
///     target faster, slower   names of two schemes ratio            [lowest, highest] of the time
///     of `slower` over that of `faster` distinguishable  whether their quartiles keep them apart
///     (Comparison)
///
/// Throws InputError where a name is none of the block's, and where nothing is expected.
void expect_sooner(TableReader& table, const WorkPrecisionBlock& block,
                   std::vector<Expectation>& expectations);

} // namespace tvbeam
