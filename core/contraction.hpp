#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"

#include "core/space/mesh.hpp"

namespace tvbeam {

/// What the tip does in a solve: nothing touches it, or a rigid stop holds it. With a stop that
/// yields the iteration contracts no better than held and no worse than free.
enum class Tip { free, held };

/// The factor by which the paper's iteration between temperature and deflection changes the error
/// of the temperature in a solve with the coefficient c (Stage): the largest eigenvalue of
///
///     α²κ (M + K/c)⁻¹ M_c,     κ = 1/(1 + ζc),
///
/// which is α²Δt / ((Δt + ζ)(1 + λ₁Δt)) with Δt = 1/c and λ₁ ≈ π² the least eigenvalue of the heat
/// problem. A stop takes from the curvature what would move the tip it holds, and leaves
/// M_c − 3 b bᵀ, b_i = (1 − x, χ_i), in place of M_c: the factor is smaller, and found from below.
/// ≥ 1: the iteration diverges. One element: 0.
double contraction(const Beam& beam, const Mesh& mesh, ThermalMass mass, double c,
                   Tip tip = Tip::free);

/// The greatest of a run: over the stages of the scheme and of its starter.
double greatest_contraction(const Beam& beam, const Mesh& mesh, const Scheme& scheme, double dt,
                            Tip tip = Tip::free);

} // namespace tvbeam
