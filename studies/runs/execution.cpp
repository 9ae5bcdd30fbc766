#include "studies/runs/execution.hpp"

#include "core/scheme.hpp"
#include "studies/scene/study_keys.hpp"

namespace tvbeam {

namespace {

/// Of the fixed point over the direct algorithm: its iterations, and the solves with B.
constexpr double iterated = 20.0;

} // namespace

double work_of(const Scheme& scheme, const Rung& rung) {
    const double node_steps = static_cast<double>(rung.elements) * static_cast<double>(rung.steps);
    return node_steps * static_cast<double>(scheme.time.stages.size()) *
           (scheme.algorithm == Algorithm::fixed_point ? iterated : 1.0);
}

} // namespace tvbeam
