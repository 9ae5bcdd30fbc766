#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"

#include "core/space/mesh.hpp"

namespace tvbeam {

/// The factor by which the paper's iteration between temperature and deflection changes the error
/// of the temperature, without contact, in a solve with the coefficient c (Stage): the largest
/// eigenvalue of
///
///     α²κ (M + K/c)⁻¹ M_c,     κ = 1/(1 + ζc),
///
/// which is α²Δt / ((Δt + ζ)(1 + λ₁Δt)) with Δt = 1/c and λ₁ ≈ π² the least eigenvalue of the heat
/// problem. Contact makes it smaller. ≥ 1: the iteration diverges. One element: 0.
double contraction(const Beam& beam, const Mesh& mesh, ThermalMass mass, double c);

/// The greatest of a run: over the stages of the scheme and of its starter.
double greatest_contraction(const Beam& beam, const Mesh& mesh, const Scheme& scheme, double dt);

} // namespace tvbeam
