#include "mms/forecast/error_constants.hpp"

#include "core/norms/norm_sums.hpp"
#include "core/norms/norms.hpp"
#include "core/norms/underflow.hpp"
#include "core/space/quadrature.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/derivation.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/forecast/driven_beam.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using ArrayXb = Eigen::Array<bool, Eigen::Dynamic, 1>;
using Eigen::Index;
using Eigen::MatrixXd;
using GiNaC::ex;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double settled = 2e-3; ///< relative change of a constant from one resolution to the next
constexpr std::pair<Index, Index> resolutions[] = {
    {16, 64}, {24, 128}, {32, 256}, {48, 512}, {64, 1024}}; ///< modes, steps

/// The derivatives of the solution that truncation terms are made of, in the rows of a tape.
enum Derivative : std::uint8_t {
    theta_xx,
    theta_xxt,
    theta_tt,
    theta_ttt,
    theta_xxtt,
    w_xx,
    w_tt,
    w_ttt
};

Tape derivatives_of(const DerivedPhase& phase) {
    const auto& [x, t] = std::pair(model_symbols().x, model_symbols().t);
    const ex theta_tt = derivative(phase.theta_t, t);
    const ex w_tt = derivative(phase.u_xxt, t);
    const ex theta_xxt = derivative(phase.theta_xx, t);
    return compile_tape({phase.theta_xx, theta_xxt, theta_tt, derivative(theta_tt, t),
                         derivative(theta_xxt, t), derivative(phase.u_xxx, x), w_tt,
                         derivative(w_tt, t)});
}

/// The squares of the leading error in each quantity at the times t, and its order there.
struct Squares {
    ArrayXd t;
    std::array<ArrayXd, quantity_count> values;
    std::array<double, quantity_count> orders{};
    ArrayXd curvature = {}; ///< ∫ w_xx²
    double unit = 1.0;      ///< of the errors that these are the squares of

    ArrayXd& of(Quantity quantity) { return values[static_cast<std::size_t>(quantity)]; }
    double& order(Quantity quantity) { return orders[static_cast<std::size_t>(quantity)]; }
};

/// ∫ of the square of each column of Legendre coefficients.
ArrayXd squared_norms(const MatrixXd& coefficients) {
    ArrayXd weights =
        ArrayXd::LinSpaced(coefficients.rows(), 0.0, static_cast<double>(coefficients.rows() - 1));
    weights = (2.0 * weights + 1.0).inverse();
    return (coefficients.array().square().colwise() * weights).colwise().sum().transpose();
}

/// The coefficients of P_n' = Σ 2(2k + 1) P_k over k = n − 1, n − 3, ….
MatrixXd slopes(const MatrixXd& coefficients) {
    MatrixXd result = MatrixXd::Zero(coefficients.rows(), coefficients.cols());
    for (Index n = 1; n < coefficients.rows(); ++n)
        for (Index k = n - 1; k >= 0; k -= 2)
            result.row(k) += 2.0 * (2.0 * static_cast<double>(k) + 1.0) * coefficients.row(n);
    return result;
}

/// ∫ (1 − x) φ, with 1 − x = (P_0 − P_1)/2.
ArrayXd moments(const MatrixXd& coefficients) {
    return (coefficients.row(0) / 2.0 - coefficients.row(1) / 6.0).transpose().array();
}

/// Those of the errors of a mass matrix, and of a time scheme.
struct Squared {
    Squares space;
    Squares time;
};

class Forecaster {
public:
    /// coupled: bending has an error of the order of that of heat.
    Forecaster(const Tape& tape, const Beam& beam, bool held, bool coupled, double final_time)
        : tape_(tape), beam_(beam), held_(held), coupled_(coupled), final_time_(final_time) {
        // The fractional parts of the multiples of the golden ratio stay apart from one another;
        // times at so much of the way between two are no zeros of a sine.
        constexpr Index count = 2048;
        constexpr double golden_ratio = 0.6180339887498949;
        const ArrayXd places = ArrayXd::LinSpaced(count, golden_ratio, count - 1 + golden_ratio);
        const ArrayXd multiples = places * golden_ratio;
        peaks_ = sizes(tape_.evaluate(multiples - multiples.floor(), places * (final_time / count)),
                       0.0);
        if (const double most = peaks_.maxCoeff(); most > 0.0)
            unit_ = std::ldexp(1.0, std::ilogb(most));
        peaks_ /= unit_;
    }

    /// Of each method.
    [[nodiscard]] std::vector<Squared> squares(const std::vector<ForecastMethod>& methods,
                                               Index modes, Index steps) const {
        const auto count = static_cast<Index>(methods.size());
        const auto sources = [&](const ArrayXd& x, double t) {
            const ArrayXXd y = at(x, t);
            ArrayXXd driven(4 * count, x.size());
            for (Index k = 0; k < count; ++k) {
                const auto& [time, mass] = methods[static_cast<std::size_t>(k)];
                driven.middleRows<2>(4 * k) = truncated_in_space(mass, y);
                driven.middleRows<2>(4 * k + 2) = truncated_in_time(time, y);
            }
            return driven;
        };
        const auto errors =
            driven_beams(beam_, held_, final_time_, modes, steps, 2 * count, sources);
        const ArrayXd t = ArrayXd::LinSpaced(steps + 1, 0.0, final_time_);
        std::vector<Squared> all;
        for (std::size_t k = 0; k < methods.size(); ++k) {
            all.push_back({in_space(errors[2 * k], t), in_time(errors[2 * k + 1], t)});
            all.back().time.orders.fill(TimeScheme::named(methods[k].time_scheme).order);
            all.back().space.unit = all.back().time.unit = unit_;
        }
        add_interpolation(all, errors, t, modes);
        return all;
    }

    /// Of each derivative, whether the points and times of the driven problem miss where it is
    /// large. One without a value at a point is seen there.
    [[nodiscard]] ArrayXb missed_peaks(Index modes, Index steps) const {
        constexpr double far = 1.5;
        const ArrayXd x = GaussRule::of(2 * modes).points;
        const ArrayXd t = ArrayXd::LinSpaced(steps + 1, 0.0, final_time_);
        ArrayXd seen = ArrayXd::Zero(peaks_.size());
        for (const double time : sample_points(0.0, final_time_))
            seen = seen.max(sizes(at(x, time), infinity));
        for (const double place : sample_points(0.0, 1.0))
            seen =
                seen.max(sizes(tape_.evaluate(ArrayXd::Constant(1, place), t) / unit_, infinity));
        return peaks_ > far * seen;
    }

    /// Whether the discrete temperature leaves that of the data within a first step of any length.
    [[nodiscard]] bool jumps_at_first() const { return beam_.zeta == 0.0 && beam_.alpha != 0.0; }

    /// Whether it leaves it in a layer that steps may be longer than: in about ζ/(1 + α²).
    [[nodiscard]] bool leaves_soon() const {
        constexpr double of_final_time = 5e-3;
        return beam_.alpha != 0.0 &&
               beam_.zeta < of_final_time * final_time_ * (1.0 + beam_.alpha * beam_.alpha);
    }

    /// Whether bending has an error of the order of that of heat.
    [[nodiscard]] bool is_coupled() const { return coupled_; }

    /// Whether the beam's numbers take errors of the size one beyond the squares of doubles.
    [[nodiscard]] bool is_beyond_doubles() const {
        constexpr double largest = 1e70; // of what is squared twice, by the coupling and the norm
        return std::max(std::abs(beam_.alpha), beam_.zeta) > largest;
    }

    [[nodiscard]] bool is_hardly_viscous() const {
        return beam_.zeta > 0.0 && beam_.zeta < least_viscosity * final_time_;
    }

private:
    /// The greatest |value| of each derivative, with what one counts as that is none.
    static ArrayXd sizes(const ArrayXXd& values, double none) {
        return values.isFinite().select(values.abs(), none).rowwise().maxCoeff();
    }

    [[nodiscard]] ArrayXXd at(const ArrayXd& x, double t) const {
        return tape_.evaluate(x, ArrayXd::Constant(1, t)) / unit_;
    }

    [[nodiscard]] Eigen::Array2Xd truncated_in_time(const std::string& scheme,
                                                    const ArrayXXd& y) const {
        // Of M y'' (Euler), M y''' and −K y''.
        double second = 0.0;
        double third = 0.0;
        double stiff = 0.0;
        if (scheme == "euler")
            second = 0.5;
        else if (scheme == "bdf2")
            third = 1.0 / 3.0;
        else {
            // SDIRK2, by its Butcher tableau: A = (γ 0; 1−γ γ), b its last row, c = (γ, 1).
            const double gamma = 1.0 - std::sqrt(0.5);
            third = ((1.0 - gamma) * gamma * gamma + gamma) / 2.0 - 1.0 / 6.0;
            stiff = (1.0 - gamma) * gamma * gamma / 2.0;
        }
        Eigen::Array2Xd driven(2, y.cols());
        driven.row(0) = second * (y.row(theta_tt) - beam_.alpha * y.row(w_tt)) +
                        third * (y.row(theta_ttt) - beam_.alpha * y.row(w_ttt)) +
                        stiff * y.row(theta_xxtt);
        driven.row(1) = beam_.zeta * (second * y.row(w_tt) + third * y.row(w_ttt)) -
                        stiff * (y.row(w_tt) + beam_.alpha * y.row(theta_tt));
        return driven;
    }

    [[nodiscard]] Eigen::Array2Xd truncated_in_space(ThermalMass mass, const ArrayXXd& y) const {
        const double sign = mass == ThermalMass::lumped ? 1.0 : -1.0;
        Eigen::Array2Xd driven(2, y.cols());
        driven.row(0) = sign / 12.0 * y.row(theta_xxt);
        driven.row(1) = -beam_.alpha / 12.0 * y.row(theta_xx);
        return driven;
    }

    [[nodiscard]] Squares in_time(const DrivenBeam& error, const ArrayXd& t) const {
        Squares squares{t, {}, {}};
        squares.of(Quantity::theta) = squared_norms(error.theta);
        squares.of(Quantity::theta_x) = squared_norms(slopes(error.theta));
        add_deflection(squares, error.w);
        squares.of(Quantity::stress) = (3.0 * beam_.alpha * moments(error.theta)).square();
        return squares;
    }

    /// Without what interpolation leaves.
    [[nodiscard]] Squares in_space(const DrivenBeam& error, const ArrayXd& t) const {
        Squares squares{t, {}, {2.0, 1.0, 2.0, 2.0, 2.0, 2.0}};
        add_deflection(squares, error.w);
        for (ArrayXd& values : squares.values)
            if (values.size() == 0)
                values = ArrayXd::Zero(t.size());
        if (!coupled_) {
            squares.order(Quantity::u_x) = 3.0;
            squares.order(Quantity::u) = 4.0;
        }
        return squares;
    }

    void add_interpolation(std::vector<Squared>& all, const std::vector<DrivenBeam>& errors,
                           const ArrayXd& t, Index modes) const {
        const GaussRule rule = GaussRule::of(2 * modes);
        const MatrixXd at_points = legendre(modes + 1, rule.points).transpose();
        std::vector<MatrixXd> nodal;
        std::vector<ArrayXd> forces;
        for (std::size_t k = 0; k < all.size(); ++k) {
            nodal.emplace_back(at_points * errors[2 * k].theta);
            forces.push_back(moments(errors[2 * k].theta));
        }
        for (auto& squared : all)
            squared.space.curvature = ArrayXd::Zero(t.size());
        for (Index n = 0; n < t.size(); ++n) {
            const ArrayXXd y = at(rule.points, t(n));
            const ArrayXd bent = y.row(theta_xx).transpose();
            const double of_bent = (rule.weights * bent.square()).sum();
            const double of_w = (rule.weights * y.row(w_xx).transpose().square()).sum();
            const double moment = (rule.weights * (1.0 - rule.points) * bent).sum() / 12.0;
            for (std::size_t k = 0; k < all.size(); ++k) {
                Squares& squares = all[k].space;
                squares.curvature(n) = of_w;
                const ArrayXd node = nodal[k].col(n).array();
                squares.of(Quantity::theta)(n) =
                    (rule.weights * (node.square() + node * bent / 6.0)).sum() + of_bent / 120.0;
                squares.of(Quantity::theta_x)(n) = of_bent / 12.0;
                squares.of(Quantity::u_xx)(n) += of_w / 720.0;
                if (!coupled_) {
                    squares.of(Quantity::u_x)(n) = of_w / 30240.0;
                    squares.of(Quantity::u)(n) = of_w / 362880.0;
                }
                const double force = 3.0 * beam_.alpha * (forces[k](n) + moment);
                squares.of(Quantity::stress)(n) = force * force;
            }
        }
    }

    static void add_deflection(Squares& squares, const MatrixXd& w) {
        const MatrixXd slope = legendre_integral(w.rows()) * w;
        squares.of(Quantity::u_xx) = squared_norms(w);
        squares.of(Quantity::u_x) = squared_norms(slope);
        squares.of(Quantity::u) = squared_norms(legendre_integral(slope.rows()) * slope);
    }

    const Tape& tape_;
    const Beam& beam_;
    bool held_;
    bool coupled_;
    double final_time_;
    /// A power of 2 near the greatest size of the derivatives, in which all is computed: the errors
    /// are linear in them, and their squares could leave the range of doubles.
    double unit_ = 1.0;
    ArrayXd peaks_; ///< of each derivative the greatest size on scattered points
};

/// The first time at which a square that the norm sums up is no number.
std::optional<double> first_without_number(const Norm& norm, double order, const Squares& squares) {
    for (Index n = 0; n < squares.t.size(); ++n)
        for (const TimeNorm& part : norm.parts)
            for (std::size_t q = 0; q < quantity_count; ++q)
                if (part.quantities[q] && squares.orders[q] == order &&
                    !std::isfinite(squares.values[q](n)))
                    return squares.t(n);
    return std::nullopt;
}

/// Of the quantities that have the norm's order.
LeadingTerm leading_term(const Norm& norm, double order, const Squares& squares) {
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
double shown_below(const Norm& norm, const Squares& squares, double a) {
    if (measures(norm, Quantity::theta, Quantity::theta_x, false) ||
        measures(norm, Quantity::u_xx, Quantity::u_xx, false) ||
        !measures(norm, Quantity::u, Quantity::u_x, false))
        return 0.0;
    const bool slope = measures(norm, Quantity::u_x, Quantity::u_x, false);
    Squares own{squares.t, {}, {}};
    const auto quantity = slope ? Quantity::u_x : Quantity::u;
    for (auto& values : own.values)
        values = ArrayXd::Zero(squares.t.size());
    own.unit = squares.unit;
    own.of(quantity) = squares.curvature / (slope ? 30240.0 : 362880.0);
    own.order(quantity) = slope ? 3.0 : 4.0;
    const double constant = leading_term(norm, own.order(quantity), own).constant;
    return std::pow(a / constant, slope ? 1.0 : 0.5);
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

std::vector<NormConstants> constants_of(const Squared& squared, const Forecaster& forecaster,
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
        const auto add = [&](std::optional<LeadingTerm>& term, double of, const Squares& squares) {
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
        if (constants.in_h && forecaster.is_coupled())
            constants.shows_below = shown_below(norm, squared.space, constants.in_h->constant);
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

/// Those that the truncation terms of a method are made of.
std::vector<Derivative> derivatives_in(const std::string& time_scheme) {
    std::vector<Derivative> all{theta_xx, theta_xxt, w_xx};
    if (time_scheme != "bdf2")
        all.insert(all.end(), {theta_tt, w_tt});
    if (time_scheme != "euler")
        all.insert(all.end(), {theta_ttt, w_ttt});
    if (time_scheme == "sdirk2")
        all.push_back(theta_xxtt);
    return all;
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
            const bool misses = std::ranges::any_of(derivatives_in(methods[k].time_scheme),
                                                    [&](Derivative one) { return missed(one); });
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
        const Tape tape = derivatives_of(derived.derived.front());
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
