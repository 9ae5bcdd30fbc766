#pragma once

#include "core/problem.hpp"
#include "mms/admissible/admissibility.hpp"

namespace tvbeam {

/// The problem that a solution solves on a beam: the sources f, G and q, the end moment m, the
/// initial data, and the exact solution itself. With the integrals of G and q in closed form,
///
///     μ = Ĝ + q̂ − m = σ̃(1,t) (1 − y) + α θ̃(1,t) − (u_xx + ζ u_xxt + α θ̃)(y,t),
///
/// where θ̃(1,t) = 0 for an admissible solution.
///
/// The beam's values take the place of their symbols before anything is separated, so that with
/// alpha = 0 the terms with alpha are not there at all. A double is taken for the shortest decimal
/// that reads back as it: 0.017 is 17/1000. In each field the same profile of several phases is one
/// profile; profiles and amplitudes are shared by all fields. The result holds no symbolic
/// expression, and its functions may be called from several threads.
///
/// Throws InputError if the solution holds a constant beyond the range of a double, or what is
/// compiled is not what the text says.
ProblemData manufactured_problem(const AdmissibleSolution& solution);

} // namespace tvbeam
