#include "mms/forecast/error_constants.hpp"

#include "core/norms/norm_sums.hpp"
#include "core/norms/norms.hpp"
#include "core/space/quadrature.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/derivation.hpp"
#include "mms/expected_orders.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/forecast/driven_beam.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using GiNaC::ex;

namespace {

constexpr double least_viscosity = 0.01; ///< ζ over T, for what SDIRK2 does in a step
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

class Forecaster {
public:
    Forecaster(const Tape& tape, const Beam& beam, bool held, double final_time)
        : tape_(tape), beam_(beam), held_(held), final_time_(final_time) {}

    [[nodiscard]] Squares in_time(const TimeScheme& scheme, Index modes, Index steps) const {
        // Of M y'' (Euler), M y''' and −K y''.
        double second = 0.0;
        double third = 0.0;
        double stiff = 0.0;
        if (scheme.name == "euler")
            second = 0.5;
        else if (scheme.name == "bdf2")
            third = 1.0 / 3.0;
        else {
            // SDIRK2, by its Butcher tableau: A = (γ 0; 1−γ γ), b its last row, c = (γ, 1).
            const double gamma = 1.0 - std::sqrt(0.5);
            third = ((1.0 - gamma) * gamma * gamma + gamma) / 2.0 - 1.0 / 6.0;
            stiff = (1.0 - gamma) * gamma * gamma / 2.0;
        }
        const auto sources = [&](const ArrayXd& x, double t) {
            const Eigen::ArrayXXd y = at(x, t);
            Eigen::Array2Xd driven(2, x.size());
            driven.row(0) = second * (y.row(theta_tt) - beam_.alpha * y.row(w_tt)) +
                            third * (y.row(theta_ttt) - beam_.alpha * y.row(w_ttt)) +
                            stiff * y.row(theta_xxtt);
            driven.row(1) = beam_.zeta * (second * y.row(w_tt) + third * y.row(w_ttt)) -
                            stiff * (y.row(w_tt) + beam_.alpha * y.row(theta_tt));
            return driven;
        };
        const DrivenBeam error = driven_beam(beam_, held_, final_time_, modes, steps, sources);
        Squares squares{error.t, {}, {}};
        squares.orders.fill(scheme.order);
        squares.of(Quantity::theta) = squared_norms(error.theta);
        squares.of(Quantity::theta_x) = squared_norms(slopes(error.theta));
        add_deflection(squares, error.w);
        squares.of(Quantity::stress) = (3.0 * beam_.alpha * moments(error.theta)).square();
        return squares;
    }

    /// coupled: d is not zero.
    [[nodiscard]] Squares in_space(ThermalMass mass, bool coupled, Index modes, Index steps) const {
        const double sign = mass == ThermalMass::lumped ? 1.0 : -1.0;
        const auto sources = [&](const ArrayXd& x, double t) {
            const Eigen::ArrayXXd y = at(x, t);
            Eigen::Array2Xd driven(2, x.size());
            driven.row(0) = sign / 12.0 * y.row(theta_xxt);
            driven.row(1) = -beam_.alpha / 12.0 * y.row(theta_xx);
            return driven;
        };
        const DrivenBeam error = driven_beam(beam_, held_, final_time_, modes, steps, sources);
        Squares squares{error.t, {}, {2.0, 1.0, 2.0, 2.0, 2.0, 2.0}};
        add_deflection(squares, error.w);
        for (ArrayXd& values : squares.values)
            if (values.size() == 0)
                values = ArrayXd::Zero(error.t.size());
        const GaussRule rule = GaussRule::of(2 * modes);
        const MatrixXd nodal = legendre(modes + 1, rule.points).transpose() * error.theta;
        for (Index n = 0; n < error.t.size(); ++n) {
            const Eigen::ArrayXXd y = at(rule.points, error.t(n));
            const ArrayXd bent = y.row(theta_xx).transpose();
            const ArrayXd of_w = rule.weights * y.row(w_xx).transpose().square();
            const ArrayXd node = nodal.col(n).array();
            squares.of(Quantity::theta)(n) =
                (rule.weights * (node.square() + node * bent / 6.0 + bent.square() / 120.0)).sum();
            squares.of(Quantity::theta_x)(n) = (rule.weights * bent.square()).sum() / 12.0;
            squares.of(Quantity::u_xx)(n) += of_w.sum() / 720.0;
            if (!coupled) {
                squares.of(Quantity::u_x)(n) = of_w.sum() / 30240.0;
                squares.of(Quantity::u)(n) = of_w.sum() / 362880.0;
            }
            const double force = 3.0 * beam_.alpha *
                                 (moments(error.theta.col(n))(0) +
                                  (rule.weights * (1.0 - rule.points) * bent).sum() / 12.0);
            squares.of(Quantity::stress)(n) = force * force;
        }
        if (!coupled) {
            squares.order(Quantity::u_x) = 3.0;
            squares.order(Quantity::u) = 4.0;
        }
        return squares;
    }

    /// Whether the discrete temperature leaves that of the data within a first step of any length.
    [[nodiscard]] bool jumps_at_first() const { return beam_.zeta == 0.0 && beam_.alpha != 0.0; }

    [[nodiscard]] bool is_hardly_viscous() const {
        return beam_.zeta > 0.0 && beam_.zeta < least_viscosity * final_time_;
    }

private:
    [[nodiscard]] Eigen::ArrayXXd at(const ArrayXd& x, double t) const {
        return tape_.evaluate(x, ArrayXd::Constant(1, t));
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
    double final_time_;
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
        if (part.kind == TimeNorm::Kind::Linf)
            sum += values.maxCoeff();
        else
            sum += squares.t(1) * (values.sum() - (values(0) + values.tail(1)(0)) / 2.0);
    }
    return {order, std::sqrt(sum)};
}

std::string why_not(const ExpectedOrders& expected, const DerivedSolution& derived,
                    const Beam& beam, double final_time, const std::string& time_scheme) {
    if (expected.law_distance > 0.0)
        return "the solution is one of rigid stops, and errors stall";
    if (expected.is_in_stops)
        return "the tip passes penalised stops";
    if (expected.contact.touch)
        return "the tip touches a stop at t = " + number_text(*expected.contact.touch);
    if (!expected.contact.onsets.empty())
        return "a contact begins at t = " + number_text(expected.contact.onsets.front().t);
    if (expected.kink)
        return words_of(*expected.kink);
    if (derived.phases.front().end_value < final_time)
        return "a phase ends at t = " + number_text(derived.phases.front().end_value);
    if (!expected.switches.empty())
        return "theta_t or u_xxt jumps at t = " + number_text(expected.switches.front().t);
    if (time_scheme == "bdf2" && expected.is_quadratic)
        return "theta and u_xx are quadratic in t: BDF2 has the error of its first step alone";
    if (time_scheme == "sdirk2" && beam.zeta == 0.0)
        return "SDIRK2 without viscosity";
    // What its stages lose where zeta is no larger than a step decays with exp(-dt/zeta) alone.
    if (time_scheme == "sdirk2" && beam.zeta < least_viscosity * final_time)
        return "SDIRK2 with zeta below T/100: the sizes hold for steps far below zeta alone";
    return {};
}

const ExpectedOrder* row_of(const ExpectedOrders& expected, const std::string& norm) {
    const auto found = std::find_if(expected.orders.begin(), expected.orders.end(),
                                    [&](const ExpectedOrder& one) { return one.norm == norm; });
    return found == expected.orders.end() ? nullptr : &*found;
}

/// Whether the norm has the maximum over time of a quantity, from `first` to `last`.
bool has_maximum_of(const Norm& norm, Quantity first, Quantity last) {
    return std::ranges::any_of(norm.parts, [&](const TimeNorm& part) {
        bool has = false;
        for (std::size_t q = index(first); q <= index(last); ++q)
            has = has || part.quantities[q];
        return part.kind == TimeNorm::Kind::Linf && has;
    });
}

/// Why the sizes of a norm are not known, though those of others are; empty where they are.
std::string why_not_of(const Norm& norm, const Forecaster& forecaster, const TimeScheme& scheme) {
    if (forecaster.jumps_at_first() && has_maximum_of(norm, Quantity::theta, Quantity::theta_x))
        return "without viscosity the temperature jumps in the first step, where a maximum over "
               "time may stand";
    if (scheme.name == "bdf2" && forecaster.is_hardly_viscous() &&
        has_maximum_of(norm, Quantity::u, Quantity::u_xx))
        return "with zeta below T/100 a maximum over time of BDF2 may stand in its first step, "
               "which is one of SDIRK2";
    return {};
}

std::vector<NormConstants> constants_at(const Forecaster& forecaster,
                                        const ExpectedOrders& expected, const TimeScheme& scheme,
                                        ThermalMass mass, bool coupled,
                                        std::pair<Index, Index> resolution) {
    const auto [modes, steps] = resolution;
    const Squares space = forecaster.in_space(mass, coupled, modes, steps);
    const Squares time = forecaster.in_time(scheme, modes, steps);
    std::vector<NormConstants> all;
    for (const auto& name : Norm::names()) {
        const ExpectedOrder* order = row_of(expected, name);
        if (order == nullptr)
            continue;
        const Norm norm = *Norm::named(name);
        const double root = norm.squared ? 0.5 : 1.0;
        NormConstants constants{name, {}, std::nullopt, std::nullopt};
        constants.unknown = why_not_of(norm, forecaster, scheme);
        if (!constants.unknown.empty()) {
            all.push_back(constants);
            continue;
        }
        const auto add = [&](std::optional<LeadingTerm>& term, double of, const Squares& squares) {
            if (const auto t = first_without_number(norm, of, squares))
                constants.unknown =
                    "at t = " + number_text(*t) + " a derivative of the solution has no value";
            else
                term = leading_term(norm, of, squares);
        };
        if (order->in_h.has_error())
            add(constants.in_h, root * order->in_h.least, space);
        if (order->euler.has_error()) // every scheme or none has an error in time
            add(constants.in_dt, scheme.order, time);
        all.push_back(constants);
    }
    return all;
}

double change(const std::optional<LeadingTerm>& before, const std::optional<LeadingTerm>& now) {
    return now && now->constant > 0.0 ? std::abs(before->constant / now->constant - 1.0) : 0.0;
}

} // namespace

const NormConstants* ErrorConstants::of(const std::string& norm) const {
    const auto found = std::find_if(norms.begin(), norms.end(),
                                    [&](const NormConstants& one) { return one.norm == norm; });
    return found == norms.end() ? nullptr : &*found;
}

ErrorConstants error_constants(const Solution& solution, const Beam& beam, double final_time,
                               const std::string& time_scheme, ThermalMass mass) {
    const ExpectedOrders expected = expected_orders(solution, beam, final_time);
    const DerivedSolution derived = derive_on(solution, beam);
    ErrorConstants result{why_not(expected, derived, beam, final_time, time_scheme), {}};
    if (!result.unknown.empty())
        return result;
    try {
        const Tape tape = derivatives_of(derived.derived.front());
        const Forecaster forecaster(tape, beam, expected.contact.pressed_until.has_value(),
                                    final_time);
        const bool coupled = beam.alpha != 0.0 && !expected.theta_is_exact;
        for (const auto& resolution : resolutions) {
            const auto before = std::exchange(
                result.norms, constants_at(forecaster, expected, TimeScheme::named(time_scheme),
                                           mass, coupled, resolution));
            double most = before.empty() ? 1.0 : 0.0;
            for (std::size_t k = 0; k < before.size(); ++k)
                most = std::max({most, change(before[k].in_h, result.norms[k].in_h),
                                 change(before[k].in_dt, result.norms[k].in_dt)});
            if (most < settled)
                return result;
        }
    } catch (const AlgebraError& error) {
        return {error.what(), {}};
    }
    return {"the driven problem is not resolved: layers in space or in time, or places where the "
            "solution is not smooth, which lower the orders",
            {}};
}

} // namespace tvbeam
