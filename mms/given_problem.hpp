#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"
#include "mms/text/source_text.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// The data of a problem without known solution, as expressions in x, t (not in the initial data),
/// pi and the beam's symbols alpha, zeta, g1, g2, theta_A. What is left out is zero.
struct GivenData {
    std::optional<SourceText> theta0; ///< θ̃(x,0); θ_A at x = 0 and 0 at x = 1 (10), if it is given
    std::optional<SourceText> u0; ///< u(x,0); u0(0) = u0'(0) = 0; with rigid stops g1 ≤ u0(1) ≤ g2
    std::optional<SourceText> heat_source; ///< f(x,t) of (1)
    std::optional<SourceText> body_force;  ///< q(x,t) of (2)
    std::optional<SourceText> moment_load; ///< of a defect: added to μ of ProblemData
};

/// The expressions that are there, by name.
std::vector<std::pair<std::string, std::string>> named_parts(const GivenData& data);

/// The problem with these data: couple_load and end_moment zero, no exact solution, and
///
///     μ(y,t) = q̂(y,t) = ∫_y^1 (x − y) q(x,t) dx,
///
/// in closed form where q is a polynomial in x, otherwise by quadrature (tail_moment).
/// Throws InputError where an expression does not parse, names a stop that the beam does not have,
/// breaks (5), (6), (10), or on a grid of [0,1] × [0, final_time] is not finite or grows without
/// bound next to its largest value (sampled_rules.hpp). The result holds no symbolic expression.
ProblemData given_problem(const GivenData& data, const Beam& beam, double final_time);

/// What a deliberate defect adds (sum of core/problem.hpp) to the problem of a run on elements of
/// the width h with the step dt, which its expressions may name as h and dt. Of a solution they may
/// name the parameters and theta, theta_x, theta_t, theta_xx, u, u_x, u_xx, u_xxx, u_xxt, u_xxxt,
/// sigma, each as its phase has it; null, or without phases: nothing of it. u0 may break (6).
///
/// A moment load μ is G = −μ_x with the end moment −μ(1,t) to the Hermite form.
/// Throws InputError as given_problem does, and where a parameter has one of these names.
ProblemData given_defect(const GivenData& defect, const Solution* solution, const Beam& beam,
                         double final_time, double h, double dt);

} // namespace tvbeam
