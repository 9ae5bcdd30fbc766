#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"
#include "mms/plain_solution.hpp"

#include <string>

namespace tvbeam {

/// What remains to be said of a solution that is admissible.
struct Admissible {
    double law_distance; ///< ContactRules::law_distance
    bool tip_is_sampled; ///< ContactRules::tip_is_sampled
};

/// Checks that a solution obeys, on [0, final_time], what (5)–(10) ask of it whatever the sources
/// f, G and the end moment m are:
///
///     (5)       u(0,t) = u_x(0,t) = 0
///     (6)       g1 ≤ u(1,t) ≤ g2
///     (7)(8)    σ̃(1,t) = 0 where g1 < u(1,t) < g2 (always, without stops); ≥ 0 at g1, ≤ 0 at g2
///     (10)      θ̃(0,t) = θ_A, θ̃(1,t) = 0
///
/// with penalised stops, in place of (6)–(8), either their law (contact_rules.hpp) or, as the
/// solution of rigid stops that they approach, (6)–(8) as they stand;
///
/// further that θ̃, u and u_xx do not jump between phases, nor θ̃, θ̃_x, u and u_x in x and θ̃ and u_xx
/// in t within one, where what is derived by formulas would lack a delta function (jumps.hpp); and
/// that θ̃, u, σ̃ and what is derived from
/// them are finite on a grid of [0,1] × [0, final_time]. An equality holds if it does symbolically,
/// or else at every sampled time to 1e-12 of the largest value of θ̃ (or u, or σ̃) on the grid;
/// inequalities are sampled, with the same tolerance. (6) is proven for all times of a text's
/// solution on rigid stops, or said not to be (greatest_value.hpp).
///
/// `solution` gives the places. Throws InputError at the expression at fault; it names the
/// equation, the time, the value and a repair; and where a derived formula is not what `plain`, the
/// same solution's, says.
Admissible check_admissible(const Solution& solution, const DerivedSolution& derived,
                            const PlainSolution& plain, const Beam& beam, double final_time);

/// The same for a problem with an exact solution that no text describes; all of it is sampled, and
/// jumps are looked for between the times of a grid. Errors begin with `name` in place of a file.
Admissible require_admissible(const ProblemData& problem, const std::string& name, const Beam& beam,
                              double final_time);

/// Throws InputError unless final_time is positive and finite.
void require_final_time(double final_time);

} // namespace tvbeam
