#include "mms/forecast/expected_orders.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/contact_history.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/forecast/order_reasons.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/error_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using GiNaC::ex;

namespace {

constexpr double nearest_to_stop = 1e-9; ///< relative to the greatest |u(1,t)|

bool in_all(const DerivedSolution& derived, double final_time, const auto& holds) {
    return std::all_of(derived.derived.begin(),
                       derived.derived.begin() +
                           static_cast<std::ptrdiff_t>(phases_until(derived, final_time)),
                       holds);
}

/// Whether the derivative by s, so many times, vanishes in every phase.
bool vanishes(const DerivedSolution& derived, double final_time, ex DerivedPhase::*member,
              const GiNaC::symbol& s, int times) {
    return in_all(derived, final_time, [&](const DerivedPhase& phase) {
        ex result = phase.*member;
        for (int i = 0; i < times; ++i)
            result = derivative(result, s);
        return is_identically_zero(result);
    });
}

/// Whether every phase goes on with the formulas of the first.
bool is_one_formula(const DerivedSolution& derived, double final_time) {
    const DerivedPhase& first = derived.derived.front();
    return in_all(derived, final_time, [&](const DerivedPhase& phase) {
        return is_identically_zero(checked_difference(phase.theta, first.theta)) &&
               is_identically_zero(checked_difference(phase.u, first.u));
    });
}

/// Whether u_xxtt is other than zero at an end of the beam, in any phase.
bool bends_at_an_end(const DerivedSolution& derived, double final_time) {
    const ModelSymbols& s = model_symbols();
    return !in_all(derived, final_time, [&](const DerivedPhase& phase) {
        const ex second = derivative(phase.u_xxt, s.t);
        return is_identically_zero(substituted(second, {{s.x, 0}})) &&
               is_identically_zero(substituted(second, {{s.x, 1}}));
    });
}

/// Whether u_xxtt is other than zero somewhere at t = 0, or without a value.
bool bends_at_first(const DerivedSolution& derived) {
    const GiNaC::symbol& t = model_symbols().t;
    try {
        return !is_identically_zero(
            substituted(derivative(derived.derived.front().u_xxt, t), {{t, 0}}));
    } catch (const AlgebraError&) {
        return true; // a pole, as of t^(-1/2)
    }
}

/// Whether u(1,t) is linear in t in every phase.
bool tip_is_linear(const DerivedSolution& derived, double final_time) {
    const ModelSymbols& s = model_symbols();
    return in_all(derived, final_time, [&](const DerivedPhase& phase) {
        const ex tip = substituted(phase.u, {{s.x, 1}});
        return is_identically_zero(derivative(derivative(tip, s.t), s.t));
    });
}

bool jumps(const std::vector<Switch>& switches, double Switch::*jump) {
    return std::any_of(switches.begin(), switches.end(),
                       [jump](const Switch& change) { return change.*jump > 0.0; });
}

/// How far the tip goes beyond a penalised stop, or stays clear of it, where it is farthest, at the
/// start and at the switches.
void seek_farthest_tip(const DerivedSolution& derived, const Beam& beam, double final_time,
                       ExpectedOrders& result) {
    const Stops& stops = beam.stops;
    const PiecewiseTape tape(derived,
                             [](const DerivedPhase& phase) { return std::vector<ex>{phase.u}; });
    double size = 0.0;
    double farthest = -std::numeric_limits<double>::infinity();
    double farthest_at = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    const auto tip_at = [&](double t) { return tape.at(ArrayXd::Ones(1), t)(0, 0); };
    const auto beyond_stop = [&](double tip) {
        return std::max(tip - stops.upper, stops.lower - tip);
    };
    const auto see = [&](double t) {
        const double tip = tip_at(t);
        const double beyond = beyond_stop(tip);
        size = std::max(size, std::abs(tip));
        nearest = std::min(nearest, beyond);
        if (beyond > farthest) {
            farthest = beyond;
            farthest_at = t;
        }
    };
    for (std::size_t i = 0; i < phases_until(derived, final_time); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        for (const double t : telling_times(tape.of_phase(i), {0}, phase.begin_value,
                                            std::min(phase.end_value, final_time)))
            see(t);
    }
    result.is_in_stops = farthest > nearest_to_stop * size;
    // From the stop itself it may go in or away.
    constexpr double early = 1e-3;
    const double begin = early * std::min(derived.phases.front().end_value, final_time);
    result.starts_in_stops = result.is_in_stops &&
                             beyond_stop(tip_at(0.0)) >= -nearest_to_stop * size &&
                             beyond_stop(tip_at(begin)) > 0.0;
    if (std::abs(farthest) <= nearest_to_stop * size)
        result.contact.touch = farthest_at;
    if (const double answer = 3.0 * beam.zeta * stops.epsilon;
        !result.is_in_stops || answer == 0.0 || answer >= least_viscosity * final_time)
        return;
    result.enters_stiff_stops = nearest < -nearest_to_stop * size;
    const auto jump = std::ranges::find_if(result.switches, [&](const Switch& change) {
        return change.u_xxt_jump > 0.0 && beyond_stop(tip_at(change.t)) >= -nearest_to_stop * size;
    });
    if (jump != result.switches.end())
        result.jump_in_stiff_stops = jump->t;
}

constexpr Forecast no_error{};
constexpr Forecast unknown{Forecast::Kind::unknown, 0.0, 0.0};

Forecast between(double least, double greatest) {
    return {Forecast::Kind::between, least, greatest};
}
Forecast exactly(double order) {
    return between(order, order);
}
/// Of the sum of two errors.
Forecast slower(const Forecast& a, const Forecast& b) {
    if (!a.has_error() || !b.has_error())
        return a.has_error() ? a : b;
    if (!a.is_known() || !b.is_known())
        return unknown;
    Forecast result = between(std::min(a.least, b.least), std::min(a.greatest, b.greatest));
    result.none_at_levels = a.none_at_levels && b.none_at_levels;
    return result;
}

enum class Method { euler, bdf2, sdirk2 };

/// Every norm's orders, once what is known of the solution is.
class PredictedOrders {
public:
    PredictedOrders(const ExpectedOrders& known, const Beam& beam)
        : known_(known), beam_(beam), coupled_(beam.alpha != 0.0) {}

    [[nodiscard]] std::vector<ExpectedOrder> all() const {
        const auto row = [&](const std::string& norm, const Forecast& in_h, const auto& in_dt) {
            return ExpectedOrder{norm, in_h, in_dt(Method::euler), in_dt(Method::bdf2),
                                 in_dt(Method::sdirk2)};
        };
        const auto theta_in = [&](Over time, Method method) {
            const Forecast order = theta_in_time(method);
            return coupled_ ? with_stages(method, time, order) : order;
        };
        const auto u_in = [&](Over time, Method method) {
            return with_stages(method, time, u_in_time(method, always));
        };
        const auto theta = [&](Method method) { return theta_in(Over::square, method); };
        const auto theta_max = [&](Method method) { return theta_in(Over::maximum, method); };
        const auto slope = [&](Method method) {
            const bool has_layers = known_.stages_miss_ends && method == Method::sdirk2;
            return slower(theta(method), has_layers ? between(1.75, 2.0) : no_error);
        };
        const auto u = [&](Method method) { return u_in(Over::square, method); };
        const auto u_max = [&](Method method) { return u_in(Over::maximum, method); };
        const auto both = [&](Method method) {
            return doubled(slower(theta(method), u_max(method)));
        };
        const Forecast corollary = doubled(slower(theta_in_space(2.0), u_in_space(2.0)));
        std::vector<ExpectedOrder> result = {
            row("theta_L2L2", theta_in_space(2.0), theta),
            row("theta_LinfL2", theta_in_space(2.0), theta_max),
            row("theta_L2H1", theta_in_space(1.0), slope),
            row("u_LinfH2", u_in_space(2.0), u_max),
            row("u_LinfH2semi", u_in_space(2.0), u_max),
            row("u_L2H2", u_in_space(2.0), u),
            row("u_LinfH1", u_in_space(3.0), u_max),
            row("u_LinfL2", u_in_space(4.0), u_max),
            row("corollary", corollary, both),
        };
        if (beam_.stops.exist())
            result.push_back(row("sigma_L2", stress_in_space(),
                                 [&](Method method) { return stress_in_time(method); }));
        if (known_.law_distance > 0.0)
            for (ExpectedOrder& order : result)
                if (coupled_ || !order.norm.starts_with("theta"))
                    order.in_h = order.euler = order.bdf2 = order.sdirk2 = unknown;
        return result;
    }

private:
    static constexpr double always = std::numeric_limits<double>::infinity();

    [[nodiscard]] Forecast theta_in_space(double order) const {
        return known_.theta_is_exact ? no_error : exactly(order);
    }

    [[nodiscard]] Forecast u_in_space(double alone) const {
        const bool through_theta = coupled_ && !known_.theta_is_exact;
        if (known_.u_is_exact && !through_theta)
            return no_error;
        const double smooth = through_theta ? 2.0 : alone;
        // The element at an end misses what is rough there by this power of its length.
        const double at_end =
            known_.rough_end ? std::min(smooth, alone - 0.5 + known_.rough_end->power) : smooth;
        if (!known_.kink)
            return between(at_end, smooth);
        // Within one element the projection of u_xx misses it by the jump, or by h times it.
        const double beside_kink = alone - (known_.kink->of == Kink::Of::u_xx ? 1.5 : 0.5);
        return between(std::min(at_end, beside_kink), smooth);
    }

    /// Of what has jumps of its own, `own`, or through the coupling, up to the time `until`.
    [[nodiscard]] Forecast in_time(Method method, double Switch::*own, double until) const {
        Forecast result = order_in_time(method, own, until);
        result.none_at_levels = method != Method::bdf2 &&
                                (own == &Switch::theta_t_jump ? known_.theta_is_linear_in_pieces
                                                              : known_.u_is_linear_in_pieces);
        return result;
    }

    [[nodiscard]] Forecast order_in_time(Method method, double Switch::*own, double until) const {
        if (method == Method::euler)
            return exactly(1.0);
        const bool of_theta = own == &Switch::theta_t_jump;
        if (method == Method::bdf2 &&
            (of_theta ? known_.theta_is_quadratic : known_.u_is_quadratic))
            return known_.stages_miss_ends ? between(2.25, 3.0) : exactly(3.0);
        const bool kink =
            std::any_of(known_.switches.begin(), known_.switches.end(), [&](const Switch& change) {
                return change.t <= until &&
                       (change.*own > 0.0 ||
                        (coupled_ && (change.theta_t_jump > 0.0 || change.u_xxt_jump > 0.0)));
            });
        if (kink)
            return between(1.0, 2.0);
        double power = always;
        for (const Cusp& cusp : known_.cusps) {
            if (!(cusp.t <= until))
                continue;
            if (of_theta || coupled_)
                power = std::min(power, cusp.theta_t_power);
            if (!of_theta || coupled_)
                power = std::min(power, cusp.u_xxt_power);
        }
        return power < 1.0 ? between(1.0 + power, 2.0) : exactly(2.0);
    }

    [[nodiscard]] Forecast theta_in_time(Method method) const {
        return known_.theta_has_time_error ? in_time(method, &Switch::theta_t_jump, always)
                                           : no_error;
    }
    [[nodiscard]] Forecast u_in_time(Method method, double until) const {
        return known_.u_has_time_error ? in_time(method, &Switch::u_xxt_jump, until) : no_error;
    }

    /// j of the header: the least and the greatest. What is flatter than all powers looked for may
    /// have the next one, or be flat.
    static std::pair<double, double> powers(const ContactOnset& onset) {
        const double early = onset.approach.value_or(always) - 1.0;
        const double late = onset.force.value_or(always);
        return {std::min({early, late, highest_power - 1.0}), std::max(early, late)};
    }
    static double share(double j) {
        return std::isinf(j) ? 1.0 : (2.0 * j + 1.0) / (2.0 * j + 2.0);
    }

    [[nodiscard]] Forecast stress_in_space() const {
        if (!coupled_ || known_.theta_is_exact)
            return no_error;
        return of_stress(exactly(2.0), [&](const ContactOnset& onset) {
            return between(2.0 * share(powers(onset).first), 2.0);
        });
    }

    [[nodiscard]] Forecast stress_in_time(Method method) const {
        const bool is_held_from_the_start = !is_penalised() && known_.contact.onsets.empty() &&
                                            !known_.contact.touch && !known_.contact.within;
        if (!known_.tip_has_time_error || (!coupled_ && is_held_from_the_start))
            return no_error;
        const auto of_u = [&](double until) {
            return with_stages(method, Over::square, u_in_time(method, until));
        };
        Forecast pressed = of_u(known_.contact.pressed_until.value_or(always));
        if (known_.enters_stiff_stops) {
            Forecast entered = with_lag(method, Over::square, u_in_time(method, always));
            entered.least -= 0.5;
            pressed = slower(pressed, entered);
        }
        if (loses_force(method))
            return pressed;
        return of_stress(pressed, [&](const ContactOnset& onset) {
            Forecast result = of_u(onset.t);
            result.least -= 0.5;
            result.greatest =
                std::max(result.greatest - 0.5, result.greatest * share(powers(onset).second));
            return result;
        });
    }

    /// What a norm takes of the errors at all times.
    enum class Over { maximum, square };

    /// order, or less where the order of SDIRK2's stages, one, shows: BDF2 has them in one step
    /// alone, whose error, however large, falls with the third power of small steps.
    static Forecast of_stages(Method method, Over time, const Forecast& order) {
        if (method == Method::sdirk2)
            return slower(order, between(1.0, 2.0));
        Forecast result = slower(order, between(time == Over::maximum ? 1.0 : 1.5, always));
        result.greatest = result.is_known() ? 3.0 : result.greatest;
        return result;
    }

    /// What little viscosity shows of the stages.
    [[nodiscard]] Forecast with_lag(Method method, Over time, const Forecast& order) const {
        const bool lags = method == Method::sdirk2 ? known_.stages_lag
                          : method == Method::bdf2 ? known_.first_step_lags
                                                   : false;
        return lags ? of_stages(method, time, order) : order;
    }

    /// And what a penalised stop does, beside what it makes of a jump on it.
    [[nodiscard]] Forecast with_stages(Method method, Over time, const Forecast& order) const {
        Forecast result =
            loses_force(method) ? of_stages(method, time, order) : with_lag(method, time, order);
        if (known_.jump_in_stiff_stops)
            result.least = std::min(result.least, time == Over::maximum ? 0.0 : 0.5);
        return result;
    }

    [[nodiscard]] bool is_penalised() const { return beam_.stops.epsilon > 0.0; }

    /// Whether the force of a penalised stop has the order of SDIRK2's stages, one, and u(1,t) with
    /// it, which is off by epsilon times the force's error. BDF2 begins with a step of SDIRK2.
    [[nodiscard]] bool loses_force(Method method) const {
        const bool has_stages = method == Method::sdirk2 ? known_.is_in_stops
                                : method == Method::bdf2 ? known_.starts_in_stops
                                                         : false;
        return has_stages && is_penalised() && !known_.tip_is_linear && beam_.zeta > 0.0;
    }

    /// pressed: the order while the tip is pressed; at: what an onset leaves of it.
    template <typename AtOnset>
    [[nodiscard]] Forecast of_stress(const Forecast& pressed, const AtOnset& at) const {
        if (is_penalised())
            return known_.is_in_stops ? pressed : known_.contact.touch ? unknown : no_error;
        if (known_.contact.touch || known_.contact.within)
            return unknown;
        if (!known_.contact.pressed_until)
            return no_error;
        Forecast result = pressed;
        if (beam_.zeta > 0.0)
            for (const ContactOnset& onset : known_.contact.onsets)
                result = slower(result, at(onset));
        return result;
    }

    const ExpectedOrders& known_;
    const Beam& beam_;
    bool coupled_;
};

} // namespace

Forecast doubled(const Forecast& order) {
    return {order.kind, 2.0 * order.least, 2.0 * order.greatest, order.none_at_levels};
}

Forecast either(const Forecast& a, const Forecast& b) {
    if (!a.has_error() || !b.has_error())
        return a.has_error() ? a : b;
    if (!a.is_known() || !b.is_known())
        return unknown;
    return between(std::min(a.least, b.least), std::max(a.greatest, b.greatest));
}

std::string words_of(const Forecast& forecast) {
    if (!forecast.has_error())
        return "-";
    if (!forecast.is_known())
        return "not known";
    const auto text = [](double order) { return fmt::format("{:.3g}", order); };
    const std::string least = text(forecast.least);
    const std::string greatest = text(forecast.greatest);
    return least == greatest ? least : least + " to " + greatest;
}

std::optional<Forecast> forecast_of(const std::string& words) {
    if (words == "-")
        return no_error;
    if (words == "not known")
        return Forecast{.kind = Forecast::Kind::unknown};
    const auto order = [](std::string_view text) -> std::optional<double> {
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool is_order = error == std::errc() && end == text.data() + text.size() &&
                              std::isfinite(value) && value >= 0.0;
        return is_order ? std::optional(value) : std::nullopt;
    };
    constexpr std::string_view to = " to ";
    const std::size_t middle = words.find(to);
    const auto least = order(std::string_view(words).substr(0, middle));
    const auto greatest = middle == std::string::npos
                              ? least
                              : order(std::string_view(words).substr(middle + to.size()));
    if (!least || !greatest || *least > *greatest)
        return std::nullopt;
    return between(*least, *greatest);
}

ExpectedOrders expected_orders(const AdmissibleSolution& solution) {
    const DerivedSolution& derived = solution.derived();
    const Beam& beam = solution.beam();
    const double final_time = solution.final_time();
    return located(solution.place(), "the solution", [&] {
        const ModelSymbols& s = model_symbols();
        ExpectedOrders result;
        result.theta_is_exact = vanishes(derived, final_time, &DerivedPhase::theta_x, s.x, 1);
        result.u_is_exact = vanishes(derived, final_time, &DerivedPhase::u_xx, s.x, 2);
        result.switches = find_switches(derived, beam, final_time);
        result.cusps = find_cusps(derived, beam, final_time);
        result.kink = find_kink(derived, final_time);
        result.rough_end = find_rough_end(derived, final_time);
        result.law_distance = solution.remarks().law_distance;
        if (beam.stops.epsilon > 0.0)
            seek_farthest_tip(derived, beam, final_time, result);
        else if (beam.stops.exist())
            result.contact = contact_history(derived, beam.stops, final_time);
        const bool coupled = beam.alpha != 0.0;
        const bool theta_in_pieces = vanishes(derived, final_time, &DerivedPhase::theta, s.t, 2);
        const bool u_in_pieces = vanishes(derived, final_time, &DerivedPhase::u_xx, s.t, 2);
        result.theta_is_linear_in_pieces = theta_in_pieces && (u_in_pieces || !coupled);
        result.u_is_linear_in_pieces = u_in_pieces && (theta_in_pieces || !coupled);
        const bool theta_is_linear =
            theta_in_pieces && !jumps(result.switches, &Switch::theta_t_jump);
        const bool u_is_linear = u_in_pieces && !jumps(result.switches, &Switch::u_xxt_jump);
        result.theta_has_time_error = !theta_is_linear || (coupled && !u_is_linear);
        result.u_has_time_error =
            coupled ? result.theta_has_time_error : beam.zeta != 0.0 && !u_is_linear;
        const bool is_one = is_one_formula(derived, final_time);
        result.tip_is_linear = tip_is_linear(derived, final_time);
        result.tip_has_time_error =
            result.u_has_time_error && (coupled || !is_one || !result.tip_is_linear ||
                                        jumps(result.switches, &Switch::u_xxt_jump));
        const bool goes_on = is_one && !jumps(result.switches, &Switch::theta_t_jump) &&
                             !jumps(result.switches, &Switch::u_xxt_jump) &&
                             !find_second_rate_jump(derived, final_time);
        const auto quadratic = [&](bool has_time_error, ex DerivedPhase::*field) {
            return goes_on && has_time_error && vanishes(derived, final_time, field, s.t, 3);
        };
        result.theta_is_quadratic = quadratic(result.theta_has_time_error, &DerivedPhase::theta);
        result.u_is_quadratic = quadratic(result.u_has_time_error, &DerivedPhase::u_xx);
        if (coupled)
            result.theta_is_quadratic = result.u_is_quadratic =
                result.theta_is_quadratic && result.u_is_quadratic;
        const bool is_hardly_viscous = beam.zeta < least_viscosity * final_time;
        result.stages_miss_ends = result.theta_has_time_error && coupled && is_hardly_viscous &&
                                  bends_at_an_end(derived, final_time);
        result.stages_lag = is_hardly_viscous && beam.zeta > 0.0 && !u_in_pieces;
        result.first_step_lags = result.stages_lag && bends_at_first(derived);
        result.orders = PredictedOrders(result, beam).all();
        result.reasons = order_reasons(result, beam);
        return result;
    });
}

} // namespace tvbeam
