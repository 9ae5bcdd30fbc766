#include "mms/forecast/error_constants.hpp"

#include "core/norms/norm_sums.hpp"
#include "core/norms/norms.hpp"
#include "core/norms/underflow.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/forecast/forecaster.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using ArrayXb = Eigen::Array<bool, Eigen::Dynamic, 1>;
using Eigen::Index;

namespace {

constexpr double settled = 2e-3; ///< relative change of a constant from one resolution to the next
constexpr std::pair<Index, Index> resolutions[] = {
    {16, 64}, {24, 128}, {32, 256}, {48, 512}, {64, 1024}}; ///< modes, steps

/// The first time at which a square that the norm sums up is no number.
std::optional<double> first_without_number(const Norm& norm, double order,
                                           const LeadingSquares& squares) {
    for (Index n = 0; n < squares.t.size(); ++n)
        for (const TimeNorm& part : norm.parts)
            for (std::size_t q = 0; q < quantity_count; ++q)
                if (part.quantities[q] && squares.orders[q] == order &&
                    !std::isfinite(squares.values[q](n)))
                    return squares.t(n);
    return std::nullopt;
}

/// Of the quantities that have the norm's order.
LeadingTerm leading_term(const Norm& norm, double order, const LeadingSquares& squares) {
    double sum = 0.0;
    for (const TimeNorm& part : norm.parts) {
        ArrayXd values = ArrayXd::Zero(squares.t.size());
        for (std::size_t q = 0; q < quantity_count; ++q)
            if (part.quantities[q] && squares.orders[q] == order)
                values += squares.values[q];
        if (part.kind == TimeNorm::Kind::Linf && norm.parts.size() == 1) {
            const ArrayXd roots = squares.unit * values.sqrt();
            return {order, roots.maxCoeff(), {roots.begin(), roots.end()}, squares.t(1)};
        }
        if (part.kind == TimeNorm::Kind::Linf)
            sum += values.maxCoeff();
        else
            sum += squares.t(1) * (values.sum() - (values(0) + values.tail(1)(0)) / 2.0);
    }
    return {order, squares.unit * std::sqrt(sum)};
}

/// What the stages lose where ζ is no larger than a step decays with exp(−Δt/ζ) alone.
constexpr const char* small_viscosity =
    "SDIRK2 with zeta below T/100: the sizes hold for steps far below zeta alone";

std::string why_not(const ExpectedOrders& expected, const DerivedSolution& derived,
                    const Beam& beam, double final_time, const std::string& time_scheme) {
    if (expected.law_distance > 0.0)
        return std::string("the solution is one of rigid stops, and ") + stalling_errors(beam) +
               " stall";
    if (expected.is_in_stops)
        return "the tip passes penalised stops";
    if (expected.contact.touch)
        return expected.contact.rests_until
                   ? "the tip rests on a stop without a force"
                   : "the tip touches a stop at t = " + number_text(*expected.contact.touch);
    if (expected.contact.within)
        return "a contact begins or ends within a phase, about t = " +
               number_text(*expected.contact.within, 3);
    if (!expected.contact.onsets.empty())
        return "a contact begins at t = " + number_text(expected.contact.onsets.front().t);
    if (expected.kink)
        return words_of(*expected.kink);
    if (expected.rough_end)
        return words_of(*expected.rough_end);
    if (derived.phases.front().end_value < final_time)
        return "a phase ends at t = " + number_text(derived.phases.front().end_value);
    if (!expected.switches.empty())
        return "theta_t or u_xxt jumps at t = " + number_text(expected.switches.front().t);
    if (!expected.cusps.empty())
        return "theta_t or u_xxt has an infinite slope at t = " +
               number_text(expected.cusps.front().t);
    if (time_scheme == "bdf2" && expected.is_quadratic())
        return std::string(!expected.u_is_quadratic       ? "theta is"
                           : !expected.theta_is_quadratic ? "u_xx is"
                                                          : "theta and u_xx are") +
               " quadratic in t: BDF2 has the error of its first step alone";
    if (time_scheme != "euler")
        if (const auto t = find_second_rate_jump(derived, final_time))
            return "theta_tt or u_xxtt jumps at t = " + number_text(*t);
    if (time_scheme == "sdirk2" && beam.zeta == 0.0)
        return "SDIRK2 without viscosity";
    if (time_scheme == "sdirk2" && beam.zeta < least_viscosity * final_time && beam.alpha != 0.0)
        return small_viscosity;
    return {};
}

const ExpectedOrder* row_of(const ExpectedOrders& expected, const std::string& norm) {
    const auto found = std::find_if(expected.orders.begin(), expected.orders.end(),
                                    [&](const ExpectedOrder& one) { return one.norm == norm; });
    return found == expected.orders.end() ? nullptr : &*found;
}

/// Whether a part of the norm has a quantity, from `first` to `last`; of maxima over time alone.
bool measures(const Norm& norm, Quantity first, Quantity last, bool maxima) {
    return std::ranges::any_of(norm.parts, [&](const TimeNorm& part) {
        bool has = false;
        for (std::size_t q = index(first); q <= index(last); ++q)
            has = has || part.quantities[q];
        return has && (!maxima || part.kind == TimeNorm::Kind::Linf);
    });
}

/// The h at which the beam's own error in u_x, or in u alone, is as large as a h², which the
/// coupling brings; 0 of other norms. What is coarser shows the own order.
double shown_below(const Norm& norm, const LeadingSquares& squares, double a) {
    if (measures(norm, Quantity::theta, Quantity::theta_x, false) ||
        measures(norm, Quantity::u_xx, Quantity::u_xx, false) ||
        !measures(norm, Quantity::u, Quantity::u_x, false))
        return 0.0;
    const bool slope = measures(norm, Quantity::u_x, Quantity::u_x, false);
    LeadingSquares own{squares.t, {}, {}};
    const auto quantity = slope ? Quantity::u_x : Quantity::u;
    for (auto& values : own.values)
        values = ArrayXd::Zero(squares.t.size());
    own.unit = squares.unit;
    own.of(quantity) = squares.curvature / (slope ? 30240.0 : 362880.0);
    own.order(quantity) = slope ? 3.0 : 4.0;
    const double constant = leading_term(norm, own.order(quantity), own).constant;
    return std::pow(a / constant, slope ? 1.0 : 0.5);
}

/// The h at which what a strong coupling makes of θ within elements (error_constants.hpp) is as
/// large in u_xx as a h²; 0 of other norms.
double shown_below_coupling(const Norm& norm, const LeadingSquares& squares, double alpha,
                            double a) {
    if (!measures(norm, Quantity::u_xx, Quantity::u_xx, false))
        return 0.0;
    const auto squared_size = [&](const ArrayXd& of_theta, double factor) {
        LeadingSquares own{squares.t, {}, {}};
        for (auto& values : own.values)
            values = ArrayXd::Zero(squares.t.size());
        own.unit = squares.unit;
        own.of(Quantity::u_xx) = factor * of_theta;
        const double size = alpha * leading_term(norm, 0.0, own).constant;
        return size * size;
    };
    const double at_ends = squared_size(squares.at_ends, std::sqrt(3.0) / 864.0); // of h^5
    const double within = squared_size(squares.bending, 1.0 / 2700.0);            // of h^6
    // at_ends h + within h^2 = a^2
    return 2.0 * a * a / (at_ends + std::sqrt(at_ends * at_ends + 4.0 * within * a * a));
}

/// Why the sizes of a norm are not known, though those of others are; empty where they are.
std::string why_not_of(const Norm& norm, const ExpectedOrders& expected,
                       const Forecaster& forecaster, const TimeScheme& scheme) {
    const bool of_theta = measures(norm, Quantity::theta, Quantity::theta_x, false);
    const bool of_u = measures(norm, Quantity::u, Quantity::u_xx, false);
    const bool peak_of_theta = measures(norm, Quantity::theta, Quantity::theta_x, true);
    const bool peak_of_u = measures(norm, Quantity::u, Quantity::u_xx, true);
    if (scheme.name == "bdf2" &&
        ((expected.theta_is_quadratic && of_theta) || (expected.u_is_quadratic && of_u)))
        return "what is quadratic in t has the error of BDF2's first step alone";
    if (scheme.name == "sdirk2" && forecaster.is_hardly_viscous() && (of_u || !of_theta))
        return small_viscosity;
    if (scheme.name == "bdf2" && expected.first_step_lags && (of_u || !of_theta))
        return "with zeta below T/100 the first step of BDF2, which is one of SDIRK2, may be "
               "most of the error";
    if (forecaster.jumps_at_first() && peak_of_theta)
        return "without viscosity the temperature jumps in the first step, where a maximum over "
               "time may stand";
    if (forecaster.leaves_soon() && peak_of_theta)
        return "zeta/(1 + alpha^2) is below T/200: in about that time the temperature's error "
               "leaves "
               "what it begins with, where a maximum over time stands for shorter steps alone";
    if (forecaster.leaves_soon() && scheme.name == "sdirk2" && of_theta)
        return "zeta/(1 + alpha^2) is below T/200: what SDIRK2's stages lose of theta in that time "
               "counts for steps above it, and the size holds for far shorter ones alone";
    if (scheme.name == "bdf2" && forecaster.is_hardly_viscous() && peak_of_u)
        return "with zeta below T/100 a maximum over time of BDF2 may stand in its first step, "
               "which is one of SDIRK2";
    return {};
}

std::vector<NormConstants> constants_of(const MethodSquares& squared, const Forecaster& forecaster,
                                        const ExpectedOrders& expected, const TimeScheme& scheme) {
    std::vector<NormConstants> all;
    for (const auto& name : Norm::names()) {
        const ExpectedOrder* order = row_of(expected, name);
        if (order == nullptr)
            continue;
        const Norm norm = *Norm::named(name);
        const double root = norm.squared ? 0.5 : 1.0;
        NormConstants constants{name, {}, std::nullopt, std::nullopt};
        if (order->in_h.has_error() || order->euler.has_error())
            constants.unknown = why_not_of(norm, expected, forecaster, scheme);
        if (!constants.unknown.empty()) {
            all.push_back(constants);
            continue;
        }
        const auto add = [&](std::optional<LeadingTerm>& term, double of,
                             const LeadingSquares& squares) {
            if (const auto t = first_without_number(norm, of, squares))
                constants.unknown =
                    "at t = " + number_text(*t) +
                    (forecaster.is_beyond_doubles() ? " it, or its square, is beyond the range of "
                                                      "doubles"
                                                    : " a derivative of the solution has no value");
            else
                term = leading_term(norm, of, squares);
            if (term && !std::isfinite(term->constant)) {
                constants.unknown = "it is beyond the range of doubles";
                term.reset();
            }
            if (term && !(term->constant * term->constant >= least_square)) {
                constants.unknown = "its square is below what a double holds, or no sample meets "
                                    "what it comes from";
                term.reset();
            }
        };
        if (order->in_h.has_error())
            add(constants.in_h, root * order->in_h.least, squared.space);
        if (constants.in_h && forecaster.is_coupled()) {
            const double a = constants.in_h->constant;
            const double coupling =
                forecaster.is_strongly_coupled()
                    ? shown_below_coupling(norm, squared.space, forecaster.alpha(), a)
                    : 0.0;
            constants.hidden_by_coupling = coupling > 0.0;
            constants.shows_below = coupling > 0.0 ? coupling : shown_below(norm, squared.space, a);
            if (!(constants.shows_below < 1.0))
                constants.shows_below = 0.0;
        }
        if (order->euler.has_error()) // every scheme or none has an error in time
            add(constants.in_dt, scheme.order, squared.time);
        all.push_back(constants);
    }
    return all;
}

double change(const std::optional<LeadingTerm>& before, const std::optional<LeadingTerm>& now) {
    return now && now->constant > 0.0 ? std::abs(before->constant / now->constant - 1.0) : 0.0;
}

/// The greatest of all sizes; 1 where there is nothing before.
double change(const std::vector<NormConstants>& before, const std::vector<NormConstants>& now) {
    double most = before.empty() ? 1.0 : 0.0;
    for (std::size_t k = 0; k < before.size(); ++k)
        most = std::max(
            {most, change(before[k].in_h, now[k].in_h), change(before[k].in_dt, now[k].in_dt)});
    return most;
}

/// Finds the sizes of those methods that nothing is said to be unknown of: at the first of the
/// resolutions at which they have settled.
void settle(const std::vector<ForecastMethod>& methods, const Forecaster& forecaster,
            const ExpectedOrders& expected, std::vector<ErrorConstants>& results) {
    std::vector<std::size_t> left;
    for (std::size_t k = 0; k < methods.size(); ++k)
        if (results[k].unknown.empty())
            left.push_back(k);
    for (const auto& [modes, steps] : resolutions) {
        if (left.empty())
            return;
        const ArrayXb missed = forecaster.missed_peaks(modes, steps);
        std::vector<ForecastMethod> driven;
        driven.reserve(left.size());
        std::vector<std::size_t> missing;
        std::erase_if(left, [&](std::size_t k) {
            const bool misses =
                std::ranges::any_of(Forecaster::derivatives_in(methods[k].time_scheme),
                                    [&](Forecaster::Derivative one) { return missed(one); });
            if (misses)
                missing.push_back(k);
            return misses;
        });
        if (left.empty()) {
            left = missing;
            continue;
        }
        for (const std::size_t k : left)
            driven.push_back(methods[k]);
        const auto squares = forecaster.squares(driven, modes, steps);
        std::vector<std::size_t> unsettled = missing;
        for (std::size_t i = 0; i < left.size(); ++i) {
            auto& norms = results[left[i]].norms;
            const auto before =
                std::exchange(norms, constants_of(squares[i], forecaster, expected,
                                                  TimeScheme::named(driven[i].time_scheme)));
            if (!(change(before, norms) < settled))
                unsettled.push_back(left[i]);
        }
        left = unsettled;
    }
    for (const std::size_t k : left)
        results[k] = {"the driven problem is not resolved: layers in space or in time, or places "
                      "where the solution is not smooth, which lower the orders",
                      {}};
}

} // namespace

double LeadingTerm::seen_by(double step) const {
    if (over_time.empty())
        return 1.0;
    const double end = time_step * static_cast<double>(over_time.size() - 1);
    double most = 0.0;
    for (double n = 1.0; n * step <= end * (1.0 + 1e-9); ++n) {
        const auto at = static_cast<std::size_t>(std::llround(n * step / time_step));
        most = std::max(most, over_time[std::min(at, over_time.size() - 1)]);
    }
    return most / constant;
}

const NormConstants* ErrorConstants::of(const std::string& norm) const {
    const auto found = std::find_if(norms.begin(), norms.end(),
                                    [&](const NormConstants& one) { return one.norm == norm; });
    return found == norms.end() ? nullptr : &*found;
}

std::vector<ErrorConstants> error_constants(const ExpectedOrders& expected,
                                            const AdmissibleSolution& solution,
                                            const std::vector<ForecastMethod>& methods) {
    const DerivedSolution& derived = solution.derived();
    const Beam& beam = solution.beam();
    const double final_time = solution.final_time();
    std::vector<ErrorConstants> results;
    results.reserve(methods.size());
    for (const auto& method : methods)
        results.push_back({why_not(expected, derived, beam, final_time, method.time_scheme), {}});
    if (std::ranges::none_of(results, [](const auto& one) { return one.unknown.empty(); }))
        return results;
    try {
        const Tape tape = Forecaster::derivatives_of(derived.derived.front());
        const Forecaster forecaster(tape, beam, expected.contact.pressed_until.has_value(),
                                    beam.alpha != 0.0 && !expected.theta_is_exact, final_time);
        settle(methods, forecaster, expected, results);
    } catch (const AlgebraError& error) {
        for (auto& result : results)
            if (result.unknown.empty())
                result = {error.what(), {}};
    }
    return results;
}

} // namespace tvbeam
