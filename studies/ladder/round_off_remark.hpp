#pragma once

#include "studies/runs/rung.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A sentence where ten times the Hermite form's predicted round-off (core/round_off.hpp), the
/// factor within which the prediction holds, exceeds half of an error in the curvature; empty where
/// it does not, and for the direct algorithm. k: the norm's place in the errors of the rungs.
std::string round_off_remark(const Scene& scene, const ProblemData& data, double final_time,
                             const std::vector<RungResult>& rungs, const Norm& norm, std::size_t k);

} // namespace tvbeam
