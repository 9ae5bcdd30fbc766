#include "mms/plain_solution.hpp"

#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

using Number = Bounded<long double>;
using Jet = BoundedJet<long double>;

std::size_t index(Computed quantity) {
    return static_cast<std::size_t>(quantity);
}

/// The text that a quantity comes from.
const SourceText& source_of(const SolutionPhase& phase, Computed quantity) {
    switch (quantity) {
    case Computed::theta:
    case Computed::theta_x:
    case Computed::theta_t:
    case Computed::theta_xx:
    case Computed::heat_source:
        return phase.theta;
    case Computed::sigma:
    case Computed::body_force:
    case Computed::contact_stress:
        return phase.sigma ? *phase.sigma : phase.u;
    default:
        return phase.u;
    }
}

/// σ̃(1,t) of penalised stops (Stops::epsilon), from u(1,t).
Number penalised_stress(const Number& tip, const Stops& stops) {
    Number stress{0.0L, 0.0L};
    const auto add = [&](const Number& excess, long double sign) {
        const long double epsilon = stops.epsilon;
        stress =
            stress + Number{sign * std::max(excess.value, 0.0L) / epsilon, excess.bound / epsilon};
    };
    if (std::isfinite(stops.upper))
        add(tip - written(stops.upper), -1.0L);
    if (std::isfinite(stops.lower))
        add(written(stops.lower) - tip, 1.0L);
    return stress;
}

} // namespace

std::map<std::string, Jet> plain_constants(const Beam& beam) {
    constexpr long double pi = std::numbers::pi_v<long double>;
    return {{"pi", Jet(Number{pi, pi})},
            {"alpha", Jet(written(beam.alpha))},
            {"zeta", Jet(written(beam.zeta))},
            {"theta_A", Jet(written(beam.theta_A))},
            {"g1", Jet(written(beam.stops.lower))},
            {"g2", Jet(written(beam.stops.upper))}};
}

PlainSolution::PlainSolution(const Solution& solution, const DerivedSolution& derived,
                             const Beam& beam, double final_time)
    : solution_(&solution), alpha_(written(beam.alpha)), zeta_(written(beam.zeta)),
      stops_(beam.stops) {
    constants_ = plain_constants(beam);
    for (const auto& [name, expression] : derived.plain_parameters)
        constants_[name] = evaluated(expression, plain_constants({}));
    for (const PhaseExpressions& phase : derived.phases)
        if (phase.begin_value < final_time)
            samples_.push_back(sampled(phase, samples_.empty(), final_time));
}

PlainSolution::Samples PlainSolution::sampled(const PhaseExpressions& phase, bool first,
                                              double final_time) const {
    // Where a phase begins, the one before still holds.
    const Points points =
        points_to_compare(phase.begin_value, std::min(phase.end_value, final_time), first);
    const Index size = points.x.size();
    Samples samples{points.x, points.t, {}};
    Names names = constants_;
    for (Index k = 0; k < size; ++k)
        samples.values.push_back(at(phase, names, points.x(k), points.t(k)));
    for (Index k = 0; k < size; ++k) {
        Values& here = samples.values[static_cast<std::size_t>(k)];
        const Values& tip = samples.values[static_cast<std::size_t>(k - k % points_a_time + 1)];
        const auto of_tip = [&tip](Computed quantity) { return tip[index(quantity)]; };
        const Number viscous = zeta_ * here[index(Computed::u_xxt)];
        const Number tip_theta = of_tip(Computed::theta);
        const Number distance = {1.0L - samples.x(k), 1.0L};
        here[index(Computed::contact_stress)] = of_tip(Computed::sigma);
        here[index(Computed::end_moment)] =
            of_tip(Computed::u_xx) + zeta_ * of_tip(Computed::u_xxt);
        here[index(Computed::moment_load)] =
            of_tip(Computed::sigma) * distance + alpha_ * tip_theta -
            (here[index(Computed::u_xx)] + viscous + alpha_ * here[index(Computed::theta)]);
    }
    return samples;
}

PlainSolution::Values PlainSolution::at(const PhaseExpressions& phase, Names& names, double x,
                                        double t) const {
    const auto jet = [&](const PlainExpression& expression, int x_orders, int t_orders,
                         std::optional<double> at_x = {}) {
        if (expression.empty())
            return Jet();
        names["x"] = Jet::x(at_x.value_or(x), x_orders);
        names["t"] = Jet::t(t, t_orders);
        return evaluated(expression, names);
    };
    const Jet theta = jet(phase.plain_theta, 2, 1);
    const Jet u = jet(phase.plain_u, 3, 1);
    const Jet sigma = jet(phase.plain_sigma, 1, 0);
    Values values;
    const auto set = [&values](Computed quantity, const Number& value) {
        return values[index(quantity)] = value;
    };
    set(Computed::theta, theta.derivative(0, 0));
    set(Computed::u, u.derivative(0, 0));
    set(Computed::u_x, u.derivative(1, 0));
    set(Computed::u_xx, u.derivative(2, 0));
    set(Computed::body_force, sigma.derivative(1, 0));
    const bool of_law = phase.plain_sigma.empty() && stops_.epsilon > 0.0;
    const Number stress =
        set(Computed::sigma,
            of_law ? penalised_stress(jet(phase.plain_u, 0, 0, 1.0).derivative(0, 0), stops_)
                   : sigma.derivative(0, 0));
    const Number theta_x = set(Computed::theta_x, theta.derivative(1, 0));
    const Number theta_t = set(Computed::theta_t, theta.derivative(0, 1));
    const Number theta_xx = set(Computed::theta_xx, theta.derivative(2, 0));
    const Number u_xxt = set(Computed::u_xxt, u.derivative(2, 1));
    const Number u_xxx = set(Computed::u_xxx, u.derivative(3, 0));
    const Number u_xxxt = set(Computed::u_xxxt, u.derivative(3, 1));
    set(Computed::heat_source, theta_t - theta_xx - alpha_ * u_xxt);
    set(Computed::couple_load, stress + u_xxx + zeta_ * u_xxxt + alpha_ * theta_x);
    return values;
}

void PlainSolution::require(std::size_t phase, Computed quantity, const std::string& what,
                            const ComputedValues& computed, std::optional<double> only_x) const {
    const Samples& samples = samples_[phase];
    std::vector<Number> written_values;
    for (const Values& values : samples.values)
        written_values.push_back(values[index(quantity)]);
    const auto counts = [&](Index k) { return !only_x || samples.x(k) == *only_x; };
    const auto wrong = first_disagreement(written_values, computed, counts);
    if (!wrong)
        return;
    const SourceText& source = source_of(solution_->phases[phase], quantity);
    throw InputError(source.begin(),
                     disagreement_text(what, samples.x(*wrong), samples.t(*wrong),
                                       computed.values(*wrong),
                                       written_values[static_cast<std::size_t>(*wrong)].value));
}

} // namespace tvbeam
