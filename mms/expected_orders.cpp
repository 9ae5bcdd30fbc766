#include "mms/expected_orders.hpp"

#include "mms/admissible/admissibility.hpp"
#include "mms/admissible/jumps.hpp"
#include "mms/admissible/sampled_rules.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/local_power.hpp"
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

constexpr double jump_tolerance = 1e-9; ///< relative to what jumps

/// The phases that begin before the final time.
std::size_t phases_until(const DerivedSolution& derived, double final_time) {
    return static_cast<std::size_t>(
        std::ranges::count_if(derived.phases, [&](const PhaseExpressions& phase) {
            return phase.begin_value < final_time;
        }));
}

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

/// Whether u(1,t) is linear in t in every phase.
bool tip_is_linear(const DerivedSolution& derived, double final_time) {
    const ModelSymbols& s = model_symbols();
    return in_all(derived, final_time, [&](const DerivedPhase& phase) {
        const ex tip = substituted(phase.u, {{s.x, 1}});
        return is_identically_zero(derivative(derivative(tip, s.t), s.t));
    });
}

/// θ̃_t and u_xxt in every phase, over x.
PiecewiseTape rates(const DerivedSolution& derived) {
    return {derived, [](const DerivedPhase& phase) {
                return std::vector<ex>{phase.theta_t, phase.u_xxt};
            }};
}

/// The greatest of each rate at any time. A jump is one beside that: beside its own terms at a
/// switch, which may cancel there, round-off would be one.
ArrayXd sizes_of(const PiecewiseTape& tape, const DerivedSolution& derived, double final_time) {
    const ArrayXd x = sample_points(0.0, 1.0);
    ArrayXd sizes = ArrayXd::Zero(2);
    for (const PhaseExpressions& phase : derived.phases)
        if (phase.begin_value < final_time)
            for (const double t :
                 sample_points(phase.begin_value, std::min(phase.end_value, final_time)))
                sizes = sizes.max(tape.at(x, t).abs().rowwise().maxCoeff());
    return sizes;
}

std::vector<Switch> switches(const DerivedSolution& derived, double final_time) {
    const PiecewiseTape tape = rates(derived);
    const ArrayXd x = sample_points(0.0, 1.0);
    const ArrayXd sizes = sizes_of(tape, derived, final_time);
    std::vector<Switch> result;
    for (std::size_t i = 0; i < derived.phases.size(); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        if (!(phase.begin_value < final_time))
            break;
        const double end = std::min(phase.end_value, final_time);
        // Right at its begin a rate may have no value.
        const double begin = phase.begin_value + 1e-9 * (end - phase.begin_value);
        const bool is_expected = may_jump(phase.theta) || may_jump(phase.u);
        const double least = least_jump(is_expected);
        std::optional<Jump> greatest;
        for (const double place : parts_to_search(is_expected)) {
            const auto in_time = [&](const ArrayXd& s) {
                return tape.of_phase(i).evaluate(ArrayXd::Constant(1, place), s);
            };
            const auto jump = find_jump(in_time, uneven_grid(begin, end), least);
            if (jump && !(greatest && std::abs(jump->size) <= std::abs(greatest->size)))
                greatest = jump;
        }
        if (greatest) {
            const double size = std::abs(greatest->size);
            result.push_back(
                {greatest->at, greatest->row == 0 ? size : 0.0, greatest->row == 1 ? size : 0.0});
        }
        if (!(phase.end_value < final_time))
            break;
        const Eigen::ArrayXXd before = tape.at(x, phase.end_value);
        const Eigen::ArrayXXd after = tape.at(x, phase.end_value, true);
        const ArrayXd jumps = (after - before).abs().rowwise().maxCoeff();
        const auto jump = [&](Eigen::Index row) {
            return jumps(row) > jump_tolerance * sizes(row) ? jumps(row) : 0.0;
        };
        result.push_back({phase.end_value, jump(0), jump(1)});
    }
    return result;
}

std::vector<Cusp> cusps(const DerivedSolution& derived, double final_time) {
    const PiecewiseTape tape = rates(derived);
    const ArrayXd x = sample_points(0.0, 1.0);
    const ArrayXd sizes = sizes_of(tape, derived, final_time);
    std::vector<Cusp> result;
    // late: the end of a phase is read in the one that begins there.
    const auto look = [&](double t, bool late, double direction, double length) {
        const Eigen::ArrayXXd at_end = tape.at(x, t, late);
        const auto power = [&](Eigen::Index row) {
            return power_below_one(
                [&](double s) {
                    return (tape.at(x, t + direction * s).row(row) - at_end.row(row))
                        .abs()
                        .maxCoeff();
                },
                length, sizes(row));
        };
        const Cusp cusp{t, power(0), power(1)};
        if (std::isinf(cusp.theta_t_power) && std::isinf(cusp.u_xxt_power))
            return;
        if (!result.empty() && result.back().t == t) {
            result.back().theta_t_power = std::min(result.back().theta_t_power, cusp.theta_t_power);
            result.back().u_xxt_power = std::min(result.back().u_xxt_power, cusp.u_xxt_power);
        } else
            result.push_back(cusp);
    };
    for (const PhaseExpressions& phase : derived.phases) {
        if (!(phase.begin_value < final_time))
            break;
        const double end = std::min(phase.end_value, final_time);
        const double length = end - phase.begin_value;
        look(phase.begin_value, true, 1.0, length);
        look(end, false, -1.0, length);
    }
    return result;
}

bool jumps(const std::vector<Switch>& switches, double Switch::*jump) {
    return std::any_of(switches.begin(), switches.end(),
                       [jump](const Switch& change) { return change.*jump > 0.0; });
}

/// How far the tip goes beyond a penalised stop, or stays clear of it, where it is farthest.
void seek_farthest_tip(const DerivedSolution& derived, const Stops& stops, double final_time,
                       ExpectedOrders& result) {
    const PiecewiseTape tape(derived,
                             [](const DerivedPhase& phase) { return std::vector<ex>{phase.u}; });
    double size = 0.0;
    double farthest = -std::numeric_limits<double>::infinity();
    double farthest_at = 0.0;
    const auto see = [&](double t) {
        const double tip = tape.at(ArrayXd::Ones(1), t)(0, 0);
        const double beyond = std::max(tip - stops.upper, stops.lower - tip);
        size = std::max(size, std::abs(tip));
        if (beyond > farthest) {
            farthest = beyond;
            farthest_at = t;
        }
    };
    for (const PhaseExpressions& phase : derived.phases)
        if (phase.begin_value < final_time)
            for (const double t : ArrayXd::LinSpaced(time_points, phase.begin_value,
                                                     std::min(phase.end_value, final_time)))
                see(t);
    result.is_in_stops = farthest > jump_tolerance * size;
    if (std::abs(farthest) <= jump_tolerance * size)
        result.contact.touch = farthest_at;
}

constexpr Forecast no_error{};
constexpr Forecast unknown{Forecast::Kind::unknown, 0.0, 0.0};

Forecast between(double least, double greatest) {
    return {Forecast::Kind::between, least, greatest};
}
Forecast exactly(double order) {
    return between(order, order);
}
Forecast doubled(const Forecast& order) {
    return {order.kind, 2.0 * order.least, 2.0 * order.greatest, order.none_at_levels};
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
        const auto with_force = [&](Method method, const Forecast& order) {
            return loses_force(method) ? slower(order, between(1.0, 2.0)) : order;
        };
        const auto theta = [&](Method method) {
            return coupled_ ? with_force(method, theta_in_time(method)) : theta_in_time(method);
        };
        const auto slope = [&](Method method) {
            const bool has_layers = known_.stages_miss_ends && method == Method::sdirk2;
            return slower(theta(method), has_layers ? between(1.75, 2.0) : no_error);
        };
        const auto u = [&](Method method) { return with_force(method, u_in_time(method, always)); };
        const auto both = [&](Method method) { return doubled(slower(theta(method), u(method))); };
        const Forecast corollary = doubled(slower(theta_in_space(2.0), u_in_space(2.0)));
        std::vector<ExpectedOrder> result = {
            row("theta_L2L2", theta_in_space(2.0), theta),
            row("theta_LinfL2", theta_in_space(2.0), theta),
            row("theta_L2H1", theta_in_space(1.0), slope),
            row("u_LinfH2", u_in_space(2.0), u),
            row("u_LinfH2semi", u_in_space(2.0), u),
            row("u_L2H2", u_in_space(2.0), u),
            row("u_LinfH1", u_in_space(3.0), u),
            row("u_LinfL2", u_in_space(4.0), u),
            row("corollary", corollary, both),
        };
        if (beam_.stops.exist())
            result.push_back(row("sigma_L2", stress_in_space(),
                                 [&](Method method) { return stress_in_time(method); }));
        if (known_.law_distance > 0.0)
            for (ExpectedOrder& order : result)
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
        if (!known_.kink)
            return exactly(smooth);
        // Within one element the projection of u_xx misses it by the jump, or by h times it.
        const double beside_kink = alone - 3.5 + static_cast<double>(known_.kink->derivative);
        return between(std::min(smooth, beside_kink), smooth);
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
        const bool is_held_from_the_start = !is_penalised() && known_.contact.onsets.empty();
        if (!known_.tip_has_time_error || (!coupled_ && is_held_from_the_start))
            return no_error;
        // A jump at the end of the last contact comes too late for the stress.
        const double pressed = known_.contact.pressed_until
                                   ? std::nextafter(*known_.contact.pressed_until, 0.0)
                                   : always;
        if (loses_force(method))
            return slower(u_in_time(method, pressed), between(1.0, 2.0));
        return of_stress(u_in_time(method, pressed), [&](const ContactOnset& onset) {
            const Forecast p = u_in_time(method, onset.t);
            const auto order = [](double of_u, double j) {
                return std::max(of_u - 0.5, of_u * share(j));
            };
            const auto [least, greatest] = powers(onset);
            Forecast result = between(order(p.least, least), order(p.greatest, greatest));
            result.none_at_levels = p.none_at_levels;
            return result;
        });
    }

    [[nodiscard]] bool is_penalised() const { return beam_.stops.epsilon > 0.0; }

    /// Whether the force of a penalised stop has the order of SDIRK2's stages, one, and u(1,t) with
    /// it, which is off by epsilon times the force's error.
    [[nodiscard]] bool loses_force(Method method) const {
        return method == Method::sdirk2 && is_penalised() && known_.is_in_stops &&
               !known_.tip_is_linear && beam_.zeta > 0.0;
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

/// A jump within a phase, where a formula has one: sqrt((x - a)^2).
std::optional<Kink> kink_in(const DerivedSolution& derived, double final_time) {
    for (std::size_t i = 0; i < derived.phases.size(); ++i) {
        const PhaseExpressions& phase = derived.phases[i];
        if (phase.begin_value >= final_time)
            break;
        const double end = std::min(phase.end_value, final_time);
        const bool is_expected = may_jump(phase.u) || may_jump(phase.theta);
        const double least = least_jump(is_expected);
        int derivative = 2;
        for (const ex& formula : {derived.derived[i].u_xx, derived.derived[i].u_xxx}) {
            const Tape tape = compile_tape({formula});
            for (const double part : parts_to_search(is_expected)) {
                const ArrayXd t =
                    ArrayXd::Constant(1, phase.begin_value + part * (end - phase.begin_value));
                const auto in_x = [&](const ArrayXd& x) { return tape.evaluate(x, t); };
                const auto exactly = [&](const ArrayXd& x) { return tape.evaluate_wide(x, t); };
                if (const auto jump = find_jump(in_x, exactly, uneven_grid(0.0, 1.0), least))
                    return Kink{jump->at, derivative};
            }
            ++derivative;
        }
    }
    return std::nullopt;
}

std::string power_text(const std::string& base, std::optional<double> power) {
    if (!power)
        return fmt::format("flatter than {}^{}", base, highest_power);
    return *power == 0 ? std::string("with a jump")
                       : "like " + base + (*power == 1 ? "" : fmt::format("^{:.3g}", *power));
}

void add_contact_reasons(const ExpectedOrders& known, const Beam& beam,
                         std::vector<std::string>& text) {
    if (known.law_distance > 0.0) {
        text.push_back("The solution is one of rigid stops. Penalised ones with epsilon = " +
                       number_text(beam.stops.epsilon) + " would let its tip pass by up to " +
                       number_text(known.law_distance) +
                       ": errors do not fall to zero, and how they come to a halt is not known.");
        return;
    }
    if (known.contact.touch)
        text.push_back("at t = " + number_text(*known.contact.touch) +
                       " the tip is on a stop without a force. What is computed may press there, "
                       "or stay clear of it: the order of sigma_L2 is not known.");
    else if (known.contact.within)
        text.push_back("about t = " + number_text(*known.contact.within, 3) +
                       " a contact begins or ends within a phase: the order of sigma_L2 is not "
                       "known. Where a phase begins there, it is.");
    else if (beam.stops.exist() && !known.is_in_stops && !known.contact.pressed_until)
        text.emplace_back("The tip never reaches a stop: sigma is zero, and so is its error once "
                          "the error of u(1,t) is less than the distance.");
    if (beam.zeta == 0.0)
        return;
    // A step answers to a force with the compliance Δt/(3ζ), beside which ε must be large.
    if (known.is_in_stops)
        text.push_back("The penalised stops answer to u(1,t) at once, and sigma has its order, for "
                       "steps below 3*zeta*epsilon = " +
                       number_text(3.0 * beam.zeta * beam.stops.epsilon) +
                       "; with greater ones sigma_L2 behaves as at rigid stops" +
                       (known.tip_is_linear
                            ? "."
                            : ", but for SDIRK2: where the tip moves within a stop other than "
                              "linearly in t its order is 1, and rises to 2 only below."));
    for (const ContactOnset& onset : known.contact.onsets)
        text.push_back(
            "at t = " + number_text(onset.t) + " a contact begins: the tip comes up " +
            power_text("s", onset.approach) + ", s the time to it, and the force begins " +
            power_text("s", onset.force) +
            ". A run is there too early or too late by its error of u(1,t), and sigma_L2 "
            "loses a part of the order to that; its orders scatter from row to row.");
}

void add_switch_reasons(const ExpectedOrders& known, std::vector<std::string>& text) {
    const auto is_linear_beside = [&](const Switch& change) {
        return change.theta_t_jump > 0.0 ? known.theta_is_linear_in_pieces
                                         : known.u_is_linear_in_pieces;
    };
    for (const Switch& change : known.switches)
        if (change.theta_t_jump > 0.0 || change.u_xxt_jump > 0.0)
            text.push_back("at t = " + number_text(change.t) + " " +
                           (change.theta_t_jump > 0.0
                                ? "theta_t jumps by up to " + number_text(change.theta_t_jump)
                                : "u_xxt jumps by up to " + number_text(change.u_xxt_jump)) +
                           ": BDF2 has the order 1 in dt, and more only where the time is the "
                           "middle of a step; " +
                           (is_linear_beside(change)
                                ? "Euler and SDIRK2 have it, too, unless the time is a time level, "
                                  "where they are exact: all is linear in t on both sides"
                                : "SDIRK2 has 1 unless the time is a time level, where it has 2") +
                           ". Norms with a maximum over time show it late.");
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
    if (known.kink)
        text.push_back(words_of(*known.kink) +
                       ": where that is within an element, not between two, errors of u fall more "
                       "slowly in h." +
                       (known.kink->derivative == 2
                            ? " The formula of G lacks a delta function there, which the moments "
                              "that runs take have."
                            : ""));
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
    if (known.theta_is_quadratic || known.u_is_quadratic) {
        const std::string what = coupled ? "theta and u_xx are of degree 2 at most in t"
                                 : !known.u_is_quadratic     ? "theta is quadratic in t"
                                 : !known.theta_is_quadratic ? "u_xx is quadratic in t"
                                                             : "theta and u_xx are quadratic in t";
        const std::string where = known.is_quadratic()       ? ""
                                  : known.theta_is_quadratic ? " in theta"
                                                             : " in u";
        text.push_back(what + ": BDF2 has no error" + where +
                       " but that of its first step, which SDIRK2 makes: order " +
                       (known.stages_miss_ends ? "2.25 to 3." : "3."));
    }
    if (known.stages_miss_ends)
        text.emplace_back("zeta = 0, and u_xxtt is not zero at an end of the beam, where the "
                          "temperature is fixed: stages of SDIRK2 leave a layer there, and "
                          "theta_x has its order 1.75 to 2 in dt.");
    add_switch_reasons(known, text);
    for (const Cusp& cusp : known.cusps)
        for (const bool of_theta : {true, false}) {
            const double power = of_theta ? cusp.theta_t_power : cusp.u_xxt_power;
            const bool counts = of_theta ? known.theta_has_time_error : known.u_has_time_error;
            if (counts && !std::isinf(power))
                text.push_back(fmt::format(
                    "at t = {} {} has an infinite slope, like s^{:.3g}, s the time to it: BDF2 and "
                    "SDIRK2 have the order {:.3g} in dt{}. Norms with a maximum over time may show "
                    "it late.",
                    number_text(cusp.t), of_theta ? "theta_t" : "u_xxt", power, 1.0 + power,
                    coupled    ? ""
                    : of_theta ? " in theta"
                               : " in u"));
        }
    add_contact_reasons(known, beam, text);
    return text;
}

} // namespace

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

std::string words_of(const Kink& kink) {
    return std::string(kink.derivative == 2 ? "u_xx" : "u_xxx") +
           " jumps at x = " + number_text(kink.x);
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
        result.switches = switches(derived, final_time);
        result.cusps = cusps(derived, final_time);
        result.kink = kink_in(derived, final_time);
        result.law_distance = solution.remarks().law_distance;
        if (beam.stops.epsilon > 0.0)
            seek_farthest_tip(derived, beam.stops, final_time, result);
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
                             !jumps(result.switches, &Switch::u_xxt_jump);
        const auto quadratic = [&](bool has_time_error, ex DerivedPhase::*field) {
            return goes_on && has_time_error && vanishes(derived, final_time, field, s.t, 3);
        };
        result.theta_is_quadratic = quadratic(result.theta_has_time_error, &DerivedPhase::theta);
        result.u_is_quadratic = quadratic(result.u_has_time_error, &DerivedPhase::u_xx);
        if (coupled)
            result.theta_is_quadratic = result.u_is_quadratic =
                result.theta_is_quadratic && result.u_is_quadratic;
        result.stages_miss_ends = result.theta_has_time_error && coupled && beam.zeta == 0.0 &&
                                  bends_at_an_end(derived, final_time);
        result.orders = PredictedOrders(result, beam).all();
        result.reasons = reasons(result, beam);
        return result;
    });
}

} // namespace tvbeam
