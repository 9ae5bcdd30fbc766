#pragma once

#include "mms/solution.hpp"
#include "mms/solution_expressions.hpp"

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// One phase of a solution with what follows from it. Here θ is θ̃, the temperature of (1)–(10).
struct DerivedPhase {
    GiNaC::ex theta, theta_x;
    GiNaC::ex u, u_x, u_xx;
    GiNaC::ex sigma;
    GiNaC::ex contact_stress; ///< σ(1,t)                                               (7)(8)
    GiNaC::ex body_force; ///< q = σ_x                                                        (2)
    GiNaC::ex heat_source; ///< f = θ_t − θ_xx − α u_xxt                                       (1)
    GiNaC::ex couple_load; ///< G = σ + u_xxx + ζ u_xxxt + α θ_x                                 (3)
    GiNaC::ex end_moment; ///< m = u_xx(1,t) + ζ u_xxt(1,t)                                    (9)

    /// ∫_y^1 G dx + ∫_y^1 (x − y) q dx − m = σ(1,t)(1−y) + αθ(1,t) − (u_xx + ζu_xxt + αθ)(y,t):
    /// by parts, ∫_y^1 (x − y) σ_x dx = σ(1,t)(1−y) − ∫_y^1 σ dx.
    GiNaC::ex moment_load;

    /// The further derivatives that f, G and m are made of; u_xxxt is zero where ζ is.
    GiNaC::ex theta_t, theta_xx, u_xxx, u_xxt, u_xxxt;
};

/// Derives all of it for given α and ζ, which may be symbols or numbers.
/// `source` is the phase's text; its places go into an InputError when a derivative is too large or
/// has no value.
DerivedPhase derive(const PhaseExpressions& phase, const SolutionPhase& source,
                    const GiNaC::ex& alpha, const GiNaC::ex& zeta);

/// A solution with a beam's numbers in it, and what follows; only x and t are left as symbols.
struct DerivedSolution {
    std::vector<PhaseExpressions> phases;
    std::vector<DerivedPhase> derived; ///< one for each phase
    std::map<std::string, PlainExpression> plain_parameters;
};

/// Throws InputError as expressions_on and derive do.
DerivedSolution derive_on(const Solution& solution, const Beam& beam);

} // namespace tvbeam
