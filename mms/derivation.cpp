#include "mms/derivation.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/text/error_text.hpp"

#include <string>
#include <utility>

namespace tvbeam {

using GiNaC::ex;

DerivedPhase derive(const PhaseExpressions& phase, const SolutionPhase& source, const ex& alpha,
                    const ex& zeta) {
    const GiNaC::realsymbol& x = model_symbols().x;
    const GiNaC::realsymbol& t = model_symbols().t;
    const auto of_theta = [&](const ex& expression, const GiNaC::symbol& s) {
        return located(source.theta, "theta", [&] { return derivative(expression, s); });
    };
    const auto of_u = [&](const ex& expression, const GiNaC::symbol& s) {
        return located(source.u, "u", [&] { return derivative(expression, s); });
    };
    const auto at_tip = [&](const ex& expression, const SourceText& text, const std::string& what) {
        return located(text, what + " at x = 1", [&] { return substituted(expression, {{x, 1}}); });
    };

    DerivedPhase result;
    result.theta = phase.theta;
    result.theta_x = of_theta(phase.theta, x);
    result.u = phase.u;
    result.u_x = of_u(phase.u, x);
    result.u_xx = of_u(result.u_x, x);
    result.sigma = phase.sigma;
    const SourceText& of_sigma = source.sigma ? *source.sigma : source.u;
    result.contact_stress = at_tip(phase.sigma, of_sigma, "sigma");
    result.body_force = located(of_sigma, "sigma", [&] { return derivative(phase.sigma, x); });

    result.theta_t = of_theta(phase.theta, t);
    result.theta_xx = of_theta(result.theta_x, x);
    result.u_xxx = of_u(result.u_xx, x);
    result.u_xxt = of_u(result.u_xx, t);
    result.u_xxxt = zeta.is_zero() ? ex(0) : of_u(result.u_xxt, x);

    result.heat_source = result.theta_t - result.theta_xx - alpha * result.u_xxt;
    result.couple_load = phase.sigma + result.u_xxx + zeta * result.u_xxxt + alpha * result.theta_x;
    // A body force can be all that drives the beam.
    if (is_identically_zero(result.couple_load))
        result.couple_load = 0;
    const ex viscoelastic = result.u_xx + zeta * result.u_xxt;
    result.end_moment = at_tip(viscoelastic, source.u, "u_xx + zeta*u_xxt");
    const ex theta_at_tip = at_tip(phase.theta, source.theta, "theta");
    result.moment_load = result.contact_stress * (1 - x) - viscoelastic - alpha * phase.theta;
    if (!is_identically_zero(theta_at_tip))
        result.moment_load += alpha * theta_at_tip;
    return result;
}

DerivedSolution derive_on(const Solution& solution, const Beam& beam) {
    DerivedSolution result;
    SolutionExpressions expressions = expressions_on(solution, beam);
    result.phases = std::move(expressions.phases);
    result.plain_parameters = std::move(expressions.plain_parameters);
    for (std::size_t i = 0; i < result.phases.size(); ++i)
        result.derived.push_back(derive(result.phases[i], solution.phases[i],
                                        exact_rational(beam.alpha), exact_rational(beam.zeta)));
    return result;
}

} // namespace tvbeam
