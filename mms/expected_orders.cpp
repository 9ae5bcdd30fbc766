#include "mms/expected_orders.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

using Eigen::ArrayXd;
using GiNaC::ex;

namespace {

constexpr double jump_tolerance = 1e-9; ///< relative to what jumps

bool in_all(const DerivedSolution& derived, const auto& holds) {
    return std::all_of(derived.derived.begin(), derived.derived.end(), holds);
}

/// Whether the derivative by s, so many times, vanishes in every phase.
bool vanishes(const DerivedSolution& derived, ex DerivedPhase::*member, const GiNaC::symbol& s,
              int times) {
    return in_all(derived, [&](const DerivedPhase& phase) {
        ex result = phase.*member;
        for (int i = 0; i < times; ++i)
            result = derivative(result, s);
        return is_identically_zero(result);
    });
}

std::vector<Switch> switches(const DerivedSolution& derived, double final_time) {
    const PiecewiseTape tape(derived, [](const DerivedPhase& phase) {
        return std::vector<ex>{phase.theta_terms[0], derivative(phase.u_xx, model_symbols().t),
                               phase.contact_stress};
    });
    const ArrayXd x = sample_points(0.0, 1.0);
    std::vector<Switch> result;
    for (const PhaseExpressions& phase : derived.phases) {
        if (!(phase.end_value < final_time))
            break;
        const Eigen::ArrayXXd before = tape.at(x, phase.end_value);
        const Eigen::ArrayXXd after = tape.at(x, phase.end_value, true);
        const ArrayXd sizes = before.abs().max(after.abs()).rowwise().maxCoeff();
        const ArrayXd jumps = (after - before).abs().rowwise().maxCoeff();
        const auto jump = [&](Eigen::Index row) {
            return jumps(row) > jump_tolerance * sizes(row) ? jumps(row) : 0.0;
        };
        result.push_back({phase.end_value, jump(0), jump(1), jump(2)});
    }
    return result;
}

bool jumps(const std::vector<Switch>& switches, double Switch::*jump) {
    return std::any_of(switches.begin(), switches.end(),
                       [jump](const Switch& change) { return change.*jump > 0.0; });
}

std::vector<ExpectedOrder> orders(const ExpectedOrders& known, const Beam& beam) {
    const bool coupled = beam.alpha != 0.0;
    const bool theta_kink = jumps(known.switches, &Switch::theta_t_jump);
    const bool u_kink = jumps(known.switches, &Switch::u_xxt_jump);
    const bool jump = jumps(known.switches, &Switch::stress_jump);
    const auto of_theta = [&](double order) {
        return known.theta_is_exact ? std::nullopt : std::optional(order);
    };
    const auto of_u = [&](double alone) -> std::optional<double> {
        const bool through_theta = coupled && !known.theta_is_exact;
        if (known.u_is_exact && !through_theta)
            return std::nullopt;
        return through_theta ? 2.0 : alone;
    };
    using Order = std::optional<double>;
    const auto if_any = [](bool has_error, double order) {
        return has_error ? Order(order) : std::nullopt;
    };
    const auto second = [&](bool own_kink) {
        return own_kink || (coupled && (theta_kink || u_kink)) ? 1.0 : 2.0;
    };
    const Order theta_first = if_any(known.theta_has_time_error, 1.0);
    const Order theta_second = if_any(known.theta_has_time_error, second(theta_kink));
    const Order u_first = if_any(known.u_has_time_error, 1.0);
    const Order u_second = if_any(known.u_has_time_error, second(u_kink));
    const Order of_stress = if_any(coupled && !known.theta_is_exact, 2.0);
    std::vector<ExpectedOrder> result = {
        {"theta_L2L2", of_theta(2.0), theta_first, theta_second},
        {"theta_L2H1", of_theta(1.0), theta_first, theta_second},
        {"u_LinfH2semi", of_u(2.0), u_first, u_second},
        {"u_LinfH1", of_u(coupled ? 2.0 : 3.0), u_first, u_second},
        {"u_LinfL2", of_u(coupled ? 2.0 : 4.0), u_first, u_second},
    };
    if (beam.stops.exist())
        result.push_back({"sigma_L2", of_stress,
                          jump ? if_any(known.u_has_time_error, 0.5) : u_first,
                          jump ? if_any(known.u_has_time_error, 0.5) : u_second});
    return result;
}

std::vector<std::string> reasons(const ExpectedOrders& known, const Beam& beam) {
    const bool coupled = beam.alpha != 0.0;
    std::vector<std::string> text;
    if (known.theta_is_exact)
        text.emplace_back("theta is linear in x: the linear elements hold it exactly, and no order "
                          "in h is visible in any norm of theta.");
    if (known.u_is_exact)
        text.push_back("u is cubic in x: the cubics hold it exactly; " +
                       std::string(coupled && !known.theta_is_exact
                                       ? "what order in h is visible in u comes from theta, "
                                         "through alpha."
                                       : "no order in h is visible in any norm of u."));
    if (!coupled)
        text.emplace_back("alpha = 0: heat and bending do not see each other's errors, and u has "
                          "higher orders in the weaker norms.");
    if (!known.theta_has_time_error)
        text.emplace_back(coupled ? "theta and u_xx are linear in t: no scheme has a time error, "
                                    "and no order in dt is visible."
                                  : "theta is linear in t, and alpha = 0: no scheme has a time "
                                    "error in theta, and no order in dt is visible there.");
    if (!coupled && !known.u_has_time_error)
        text.emplace_back(beam.zeta == 0.0 ? "alpha = zeta = 0: the beam has no memory, and u no "
                                             "time error."
                                           : "u_xx is linear in t, and alpha = 0: no scheme has a "
                                             "time error in u, and no order in dt is visible "
                                             "there.");
    for (const Switch& change : known.switches) {
        const std::string at = "at t = " + number_text(change.t) + " ";
        if (change.theta_t_jump > 0.0 || change.u_xxt_jump > 0.0)
            text.push_back(at +
                           (change.theta_t_jump > 0.0
                                ? "theta_t jumps by up to " + number_text(change.theta_t_jump)
                                : "u_xxt jumps by up to " + number_text(change.u_xxt_jump)) +
                           ": BDF2 has the order 1 in dt, SDIRK2 too unless the time is a time "
                           "level.");
        else
            text.push_back(at +
                           "one formula follows another without a jump of theta_t or u_xxt. A run "
                           "finds a change of contact at an instant of its own, which can take up "
                           "to one half from the order 2 in norms with a maximum over time.");
        if (change.stress_jump > 0.0)
            text.push_back(at + "sigma jumps by " + number_text(change.stress_jump) +
                           ", at an instant that a run knows to one step: sigma_L2 has the order "
                           "1/2 in dt.");
    }
    return text;
}

} // namespace

ExpectedOrders expected_orders(const Solution& solution, const Beam& beam, double final_time) {
    const DerivedSolution derived = derive_on(solution, beam);
    return located(solution.phases.front().u, "the solution", [&] {
        const ModelSymbols& s = model_symbols();
        ExpectedOrders result;
        result.theta_is_exact = vanishes(derived, &DerivedPhase::theta_x, s.x, 1);
        result.u_is_exact = vanishes(derived, &DerivedPhase::u_xx, s.x, 2);
        result.switches = switches(derived, final_time);
        const bool theta_is_linear = vanishes(derived, &DerivedPhase::theta, s.t, 2) &&
                                     !jumps(result.switches, &Switch::theta_t_jump);
        const bool u_is_linear = vanishes(derived, &DerivedPhase::u_xx, s.t, 2) &&
                                 !jumps(result.switches, &Switch::u_xxt_jump);
        const bool coupled = beam.alpha != 0.0;
        result.theta_has_time_error = !theta_is_linear || (coupled && !u_is_linear);
        result.u_has_time_error =
            coupled ? result.theta_has_time_error : beam.zeta != 0.0 && !u_is_linear;
        result.orders = orders(result, beam);
        result.reasons = reasons(result, beam);
        return result;
    });
}

} // namespace tvbeam
