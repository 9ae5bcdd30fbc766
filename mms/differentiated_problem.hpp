#pragma once

#include "core/problem.hpp"

#include <functional>
#include <string>
#include <vector>

namespace tvbeam {

/// θ̃ at a point, with its derivatives.
struct TemperatureAt {
    double value, x, xx, t;
};

/// u at a point, with its derivatives.
struct DeflectionAt {
    double value, x, xx, xxx, xxt, xxxt;
};

/// σ̃ at a point, with its derivative.
struct StressAt {
    double value, x;
};

/// An exact solution as functions that know their derivatives, however they come by them: by
/// automatic differentiation (autodiff_problem.hpp), or by hand. What holds in phases branches on t
/// alone. The functions may be called from several threads.
struct DifferentiatedSolution {
    std::string name; ///< that messages begin with
    std::function<TemperatureAt(double x, double t)> theta;
    std::function<DeflectionAt(double x, double t)> u;
    std::function<StressAt(double x, double t)> sigma; ///< empty: zero at all times
    std::vector<double> phase_ends; ///< times at which it branches; see ProblemData::phase_ends
};

/// The problem that the solution solves on a beam, as manufactured_problem makes it of a text: the
/// same f, G, q, m, μ, initial data and exact solution. Nothing is separated into products: sources
/// and errors are evaluated at every point anew.
///
/// Throws InputError if the solution is not admissible on [0, final_time] (admissibility.hpp).
ProblemData differentiated_problem(const DifferentiatedSolution& solution, const Beam& beam,
                                   double final_time);

} // namespace tvbeam
