#pragma once

#include "studies/gates/expectation.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <functional>
#include <vector>

namespace tvbeam {

struct WorkPrecisionResult;

/// Reads [[expect.work_precision.sooner]]: how much sooner the scheme `faster` reaches the error of
/// the norm than the scheme `slower`, by the medians of their times. The error is one that schemes
/// are compared at: a power of ten, or a target. ratio = [lowest, highest] is of the time of
/// `slower` over that of `faster`; distinguishable says whether their quartiles keep them apart
/// (Comparison). Throws InputError where a name is none of the block's, and where nothing is
/// expected.
/// @param record the record of the study in a result
void expect_sooner(TableReader& table, const WorkPrecisionBlock& block,
                   const std::function<const WorkPrecisionResult&(const StudyResult&)>& record,
                   std::vector<Expectation>& expectations);

} // namespace tvbeam
