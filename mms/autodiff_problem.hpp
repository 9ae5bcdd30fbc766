#pragma once

#include "core/problem.hpp"
#include "mms/differentiated_problem.hpp"

#include <boost/math/differentiation/autodiff.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tvbeam {

/// A number that carries the derivatives of a function of x and t up to ∂_x^orders ∂_t; at(i, j) is
/// ∂_x^i ∂_t^j over i! j!. It takes part in arithmetic, in comparisons (by value) and in exp, sin,
/// sqrt and so on, found by argument as in exp(t). Of Boost.Math.
template <std::size_t orders>
using Jet = boost::math::differentiation::promote<
    std::tuple_element_t<0, decltype(boost::math::differentiation::make_ftuple<double, orders, 1>(
                                0.0, 0.0))>,
    std::tuple_element_t<1, decltype(boost::math::differentiation::make_ftuple<double, orders, 1>(
                                0.0, 0.0))>>;

/// g(x, t) with its derivatives.
template <std::size_t orders, typename Function>
Jet<orders> jet_of(const Function& g, double x, double t) {
    const auto variables = boost::math::differentiation::make_ftuple<double, orders, 1>(x, t);
    const Jet<orders> x_jet(std::get<0>(variables));
    const Jet<orders> t_jet(std::get<1>(variables));
    return Jet<orders>(g(x_jet, t_jet));
}

/// The problem that an exact solution written in C++ solves on a beam, with the derivatives by
/// Boost.Math's automatic differentiation (DifferentiatedSolution). `solution` is copied and has
///
///     template <typename Real> Real theta(const Real& x, const Real& t) const;  // θ̃
///     template <typename Real> Real u(const Real& x, const Real& t) const;
///     … sigma(const Real& t) const, the contact stress σ̃(t), or sigma(x, t)     // or none: zero
///     std::string name;                                    // or none: messages say "solution"
///     std::vector<double> phase_ends;                      // or none
///
/// as functions or as members that hold generic callables. In time it may have phases: it then
/// branches on t alone, and what holds up to a time holds at it, as in `if (t <= 1.0)`. phase_ends
/// names the times: a time level that is one of them to round-off then is that double, and a result
/// says what an end within a step costs. A time that is not named is met where its decimal is a
/// time level's, 0.3 or 1.0 but not sqrt(2.0).
/// Boost.Math's pow has no derivatives where its base is zero: a product has.
///
/// Throws InputError if the solution is not admissible on [0, final_time] (admissibility.hpp).
template <typename CppSolution>
ProblemData autodiff_problem(CppSolution solution, const Beam& beam, double final_time) {
    const auto exact = std::make_shared<const CppSolution>(std::move(solution));
    DifferentiatedSolution differentiated;
    differentiated.name = "solution";
    if constexpr (requires { std::string(exact->name); })
        differentiated.name = exact->name;
    if constexpr (requires { std::vector<double>(exact->phase_ends); })
        differentiated.phase_ends = exact->phase_ends;
    differentiated.theta = [exact](double x, double t) -> TemperatureAt {
        const auto theta = jet_of<2>(
            [&](const auto& at, const auto& when) { return exact->theta(at, when); }, x, t);
        return {theta.at(0, 0), theta.at(1, 0), 2.0 * theta.at(2, 0), theta.at(0, 1)};
    };
    differentiated.u = [exact](double x, double t) -> DeflectionAt {
        const auto u =
            jet_of<3>([&](const auto& at, const auto& when) { return exact->u(at, when); }, x, t);
        return {u.at(0, 0),       u.at(1, 0),       2.0 * u.at(2, 0),
                6.0 * u.at(3, 0), 2.0 * u.at(2, 1), 6.0 * u.at(3, 1)};
    };
    using J = Jet<2>;
    if constexpr (requires(const J& x, const J& t) { exact->sigma(x, t); })
        differentiated.sigma = [exact](double x, double t) -> StressAt {
            const auto sigma = jet_of<2>(
                [&](const auto& at, const auto& when) { return exact->sigma(at, when); }, x, t);
            return {sigma.at(0, 0), sigma.at(1, 0)};
        };
    else if constexpr (requires(const J& t) { exact->sigma(t); })
        differentiated.sigma = [exact](double /*x*/, double t) -> StressAt {
            const auto sigma = jet_of<2>(
                [&](const auto& /*at*/, const auto& when) { return exact->sigma(when); }, 1.0, t);
            return {sigma.at(0, 0), 0.0};
        };
    else
        // One that takes plain numbers alone would be passed over, and the stress be zero.
        static_assert(
            !requires { exact->sigma(0.0, 0.0); } && !requires { exact->sigma(0.0); },
            "sigma must take any type of number, as theta and u do");
    return differentiated_problem(differentiated, beam, final_time);
}

} // namespace tvbeam
