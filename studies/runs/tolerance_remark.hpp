#pragma once

#include "studies/runs/execution.hpp"
#include "studies/runs/run.hpp"
#include "studies/scene/scene.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// The fixed point of the paper's algorithm is left where its last change is below the tolerance τ:
/// with ρ the predicted contraction (core/contraction.hpp) up to τ ρ/(1 − ρ) before it, in every
/// step, which may add up over the steps of a unit of time. Where that is a tenth of an error of
/// the series' last run or more, that run is made again by the direct algorithm, and where a tenth
/// of an error differs, with a tolerance at which the iteration leaves nothing to be seen: a
/// sentence on what that changes, which the iteration leaves, and one on the rest, which is
/// round-off of the Hermite form; where it does not come so close, one on either. Empty where there
/// is nothing to say, and of the direct algorithm.
std::string tolerance_remark(const Scene& scene, const Series& series,
                             const std::vector<RungResult>& runs, const RunCall& run,
                             const Execution& execution);

} // namespace tvbeam
