#include "mms/forecast/forecaster.hpp"

#include "core/space/quadrature.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/sample_points.hpp"

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

} // namespace

Tape Forecaster::derivatives_of(const DerivedPhase& phase) {
    const auto& [x, t] = std::pair(model_symbols().x, model_symbols().t);
    const ex theta_tt = derivative(phase.theta_t, t);
    const ex w_tt = derivative(phase.u_xxt, t);
    const ex theta_xxt = derivative(phase.theta_xx, t);
    return compile_tape({phase.theta_xx, theta_xxt, theta_tt, derivative(theta_tt, t),
                         derivative(theta_xxt, t), derivative(phase.u_xxx, x), w_tt,
                         derivative(w_tt, t)});
}

std::vector<Forecaster::Derivative> Forecaster::derivatives_in(const std::string& time_scheme) {
    std::vector<Derivative> all{theta_xx, theta_xxt, w_xx};
    if (time_scheme != "bdf2")
        all.insert(all.end(), {theta_tt, w_tt});
    if (time_scheme != "euler")
        all.insert(all.end(), {theta_ttt, w_ttt});
    if (time_scheme == "sdirk2")
        all.push_back(theta_xxtt);
    return all;
}

Forecaster::Forecaster(const Tape& tape, const Beam& beam, bool held, bool coupled,
                       double final_time)
    : tape_(tape), beam_(beam), held_(held), coupled_(coupled), final_time_(final_time) {
    // The fractional parts of the multiples of the golden ratio stay apart from one another;
    // times at so much of the way between two are no zeros of a sine.
    constexpr Index count = 2048;
    constexpr double golden_ratio = 0.6180339887498949;
    const ArrayXd places = ArrayXd::LinSpaced(count, golden_ratio, count - 1 + golden_ratio);
    const ArrayXd multiples = places * golden_ratio;
    peaks_ =
        sizes(tape_.evaluate(multiples - multiples.floor(), places * (final_time / count)), 0.0);
    if (const double most = peaks_.maxCoeff(); most > 0.0)
        unit_ = std::ldexp(1.0, std::ilogb(most));
    peaks_ /= unit_;
}

std::vector<MethodSquares> Forecaster::squares(const std::vector<ForecastMethod>& methods,
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
    const auto errors = driven_beams(beam_, held_, final_time_, modes, steps, 2 * count, sources);
    const ArrayXd t = ArrayXd::LinSpaced(steps + 1, 0.0, final_time_);
    std::vector<MethodSquares> all;
    for (std::size_t k = 0; k < methods.size(); ++k) {
        all.push_back({in_space(errors[2 * k], t), in_time(errors[2 * k + 1], t)});
        all.back().time.orders.fill(TimeScheme::named(methods[k].time_scheme).order);
        all.back().space.unit = all.back().time.unit = unit_;
    }
    add_interpolation(all, errors, t, modes);
    return all;
}

ArrayXb Forecaster::missed_peaks(Index modes, Index steps) const {
    constexpr double far = 1.5;
    const ArrayXd x = GaussRule::of(2 * modes).points;
    const ArrayXd t = ArrayXd::LinSpaced(steps + 1, 0.0, final_time_);
    ArrayXd seen = ArrayXd::Zero(peaks_.size());
    for (const double time : sample_points(0.0, final_time_))
        seen = seen.max(sizes(at(x, time), infinity));
    for (const double place : sample_points(0.0, 1.0))
        seen = seen.max(sizes(tape_.evaluate(ArrayXd::Constant(1, place), t) / unit_, infinity));
    return peaks_ > far * seen;
}

bool Forecaster::leaves_soon() const {
    constexpr double of_final_time = 5e-3;
    return beam_.alpha != 0.0 &&
           beam_.zeta < of_final_time * final_time_ * (1.0 + beam_.alpha * beam_.alpha);
}

bool Forecaster::is_beyond_doubles() const {
    constexpr double largest = 1e70; // of what is squared twice, by the coupling and the norm
    return std::max(std::abs(beam_.alpha), beam_.zeta) > largest;
}

bool Forecaster::is_hardly_viscous() const {
    return beam_.zeta > 0.0 && beam_.zeta < least_viscosity * final_time_;
}

ArrayXd Forecaster::sizes(const ArrayXXd& values, double none) {
    return values.isFinite().select(values.abs(), none).rowwise().maxCoeff();
}

ArrayXXd Forecaster::at(const ArrayXd& x, double t) const {
    return tape_.evaluate(x, ArrayXd::Constant(1, t)) / unit_;
}

Eigen::Array2Xd Forecaster::truncated_in_time(const std::string& scheme, const ArrayXXd& y) const {
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

Eigen::Array2Xd Forecaster::truncated_in_space(ThermalMass mass, const ArrayXXd& y) const {
    const double sign = mass == ThermalMass::lumped ? 1.0 : -1.0;
    Eigen::Array2Xd driven(2, y.cols());
    driven.row(0) = sign / 12.0 * y.row(theta_xxt);
    driven.row(1) = -beam_.alpha / 12.0 * y.row(theta_xx);
    return driven;
}

LeadingSquares Forecaster::in_time(const DrivenBeam& error, const ArrayXd& t) const {
    LeadingSquares squares{t, {}, {}};
    squares.of(Quantity::theta) = squared_norms(error.theta);
    squares.of(Quantity::theta_x) = squared_norms(slopes(error.theta));
    add_deflection(squares, error.w);
    squares.of(Quantity::stress) = (3.0 * beam_.alpha * moments(error.theta)).square();
    return squares;
}

LeadingSquares Forecaster::in_space(const DrivenBeam& error, const ArrayXd& t) const {
    LeadingSquares squares{t, {}, {2.0, 1.0, 2.0, 2.0, 2.0, 2.0}};
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

void Forecaster::add_interpolation(std::vector<MethodSquares>& all,
                                   const std::vector<DrivenBeam>& errors, const ArrayXd& t,
                                   Index modes) const {
    const GaussRule rule = GaussRule::of(2 * modes);
    const MatrixXd at_points = legendre(modes + 1, rule.points).transpose();
    std::vector<MatrixXd> nodal;
    std::vector<ArrayXd> forces;
    for (std::size_t k = 0; k < all.size(); ++k) {
        nodal.emplace_back(at_points * errors[2 * k].theta);
        forces.push_back(moments(errors[2 * k].theta));
    }
    for (auto& squared : all)
        for (ArrayXd* values :
             {&squared.space.curvature, &squared.space.at_ends, &squared.space.bending})
            *values = ArrayXd::Zero(t.size());
    for (Index n = 0; n < t.size(); ++n) {
        const ArrayXXd y = at(rule.points, t(n));
        const ArrayXd bent = y.row(theta_xx).transpose();
        const double of_bent = (rule.weights * bent.square()).sum();
        const double of_w = (rule.weights * y.row(w_xx).transpose().square()).sum();
        const double moment = (rule.weights * (1.0 - rule.points) * bent).sum() / 12.0;
        for (std::size_t k = 0; k < all.size(); ++k) {
            LeadingSquares& squares = all[k].space;
            squares.curvature(n) = of_w;
            if (coupled_)
                add_third_derivative(squares, n, rule.weights * bent, at_points);
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

void Forecaster::add_third_derivative(LeadingSquares& squares, Index n, const ArrayXd& weighted,
                                      const MatrixXd& at_points) {
    const ArrayXd k =
        ArrayXd::LinSpaced(at_points.cols(), 0.0, static_cast<double>(at_points.cols() - 1));
    const MatrixXd coefficients =
        ((2.0 * k + 1.0) * (at_points.transpose() * weighted.matrix()).array()).matrix();
    double even = 0.0;
    double odd = 0.0;
    for (Index i = 0; i < coefficients.rows(); ++i)
        (i % 2 == 0 ? even : odd) += coefficients(i);
    squares.at_ends(n) = 2.0 * (even * even + odd * odd);
    squares.bending(n) = squared_norms(slopes(coefficients))(0);
}

void Forecaster::add_deflection(LeadingSquares& squares, const MatrixXd& w) {
    const MatrixXd slope = legendre_integral(w.rows()) * w;
    squares.of(Quantity::u_xx) = squared_norms(w);
    squares.of(Quantity::u_x) = squared_norms(slope);
    squares.of(Quantity::u) = squared_norms(legendre_integral(slope.rows()) * slope);
}

} // namespace tvbeam
