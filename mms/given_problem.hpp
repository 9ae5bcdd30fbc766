#pragma once

#include "core/problem.hpp"
#include "mms/text/source_text.hpp"

#include <optional>

namespace tvbeam {

/// The data of a problem without known solution, as expressions in x, t (not in the initial data),
/// pi and the beam's symbols alpha, zeta, g1, g2, theta_A. What is left out is zero.
struct GivenData {
    std::optional<SourceText> theta0; ///< θ̃(x,0)
    std::optional<SourceText> u0; ///< u(x,0); u0(0) = u0'(0) = 0; with rigid stops g1 ≤ u0(1) ≤ g2
    std::optional<SourceText> heat_source; ///< f(x,t) of (1)
    std::optional<SourceText> body_force;  ///< q(x,t) of (2)
};

/// The problem with these data: couple_load and end_moment zero, no exact solution, and
///
///     μ(y,t) = q̂(y,t) = ∫_y^1 (x − y) q(x,t) dx,
///
/// in closed form where q is a polynomial in x, otherwise by quadrature (tail_moment).
/// Throws InputError where an expression does not parse, names a stop that the beam
/// does not have, breaks (5), (6) or is not finite on a grid of [0,1] × [0, final_time]. The result
/// holds no symbolic expression.
ProblemData given_problem(const GivenData& data, const Beam& beam, double final_time);

} // namespace tvbeam
