#pragma once

#include "studies/runs/run.hpp"
#include "studies/scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// An error beside what the fixed point leaves.
struct IteratedError {
    double left = 0.0; ///< over the error
    std::string words; ///< of what error, and where
};

/// The fixed point of the paper's algorithm is left where its last change is below the tolerance τ:
/// with ρ the predicted contraction (core/contraction.hpp) up to τ ρ/(1 − ρ) before it, in every
/// step, which may add up over the steps of a unit of time. The error, of all that a series
/// measures, that is least beside this; none of the direct algorithm. Contact stresses are left
/// out: the tolerance is not of them.
std::optional<IteratedError> least_beside_tolerance(const Scene& scene, const Series& series,
                                                    const std::vector<RungResult>& runs);

/// A sentence where what the fixed point leaves is a tenth of an error or more; else empty.
std::string tolerance_remark(const std::optional<IteratedError>& error);

} // namespace tvbeam
