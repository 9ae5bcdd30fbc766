#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"
#include "studies/stress/stress_block.hpp"

namespace tvbeam {

/// The problem of a stress case, with T the time of its run:
///
///     f = L cos(2πt/T) 4x(1 − x),     G = −3L cos(2πt/T + 1),     m = L sin(2πt/T)
///
/// so that μ = G (1 − x) − m; every profile is a polynomial, which the quadratures of both forms
/// integrate exactly. Initial data of size 1 on the mesh (InitialData); u_xx is in P1disc, but for
/// the smooth one. No symbols: the problem is the same whatever the parameters. The exact solution
/// is zero, so that error norms are the norms of the solution.
ProblemData stress_problem(const StressParameters& parameters, const Mesh& mesh);

} // namespace tvbeam
