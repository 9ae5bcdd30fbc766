#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"
#include "core/space/mesh.hpp"
#include "core/space/resolution.hpp"

#include <vector>

namespace tvbeam {

/// The part of each error that quadrature leaves uncertain. With δ = Resolution::uncertainty, the
/// size S of the exact solution in the norm and L = Σ ‖load‖ where that is greatest in time: loads
/// that are wrong by δ move the solution by δ (S + L), as ‖θ‖ ≤ ‖f‖ and ‖u_xx‖ ≤ ‖μ‖ but for the
/// coupling, and the integral of a squared error e² is wrong by δS²:
///
///     (δ (S + L) + min(√δ S, δS²/2e)) / e
///
/// both of a norm, not its square. S and L are taken at 17 times and 8192 places, S of a computed
/// solution (one with elements) at the last. data.exact must be set; empty where the functions are
/// resolved on the mesh.
std::vector<double> quadrature_uncertainties(const ProblemData& data,
                                             const std::vector<const Field*>& loads,
                                             const Resolution& resolution, const Mesh& mesh,
                                             const std::vector<Norm>& norms,
                                             const std::vector<double>& errors, double final_time);

} // namespace tvbeam
