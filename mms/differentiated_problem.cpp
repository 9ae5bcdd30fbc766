#include "mms/differentiated_problem.hpp"

#include "core/contact/contact.hpp"
#include "mms/admissible/admissibility.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

/// A function at a point as one on arrays of points.
template <typename AtPoint>
Field pointwise(AtPoint at) {
    Field field;
    field.rest = [at = std::move(at)](const ArrayXd& x, double t) -> ArrayXd {
        return x.unaryExpr([&](double point) { return at(point, t); });
    };
    return field;
}

ExactSolution exact_solution(const DifferentiatedSolution& solution) {
    const auto theta = solution.theta;
    const auto u = solution.u;
    ExactSolution exact;
    exact.theta = pointwise([theta](double x, double t) { return theta(x, t).value; });
    exact.theta_x = pointwise([theta](double x, double t) { return theta(x, t).x; });
    exact.u = pointwise([u](double x, double t) { return u(x, t).value; });
    exact.u_x = pointwise([u](double x, double t) { return u(x, t).x; });
    exact.u_xx = pointwise([u](double x, double t) { return u(x, t).xx; });
    return exact;
}

/// μ = σ̃(1,t) (1 − y) − (u_xx + ζ u_xxt + α θ̃)(y,t), as θ̃(1,t) = 0.
Field moment_load(const DifferentiatedSolution& solution, const Beam& beam) {
    Field field;
    field.rest = [solution, beam](const ArrayXd& x, double t) -> ArrayXd {
        const double tip_stress = solution.sigma ? solution.sigma(1.0, t).value : 0.0;
        return x.unaryExpr([&](double y) {
            const DeflectionAt u = solution.u(y, t);
            return tip_stress * (1.0 - y) - u.xx - beam.zeta * u.xxt -
                   beam.alpha * solution.theta(y, t).value;
        });
    };
    return field;
}

/// m, and σ̃(1,t) where there is a stress.
Amplitudes end_values(const DifferentiatedSolution& solution, double zeta) {
    return [solution, zeta](const ArrayXd& times) {
        Eigen::ArrayXXd values(solution.sigma ? 2 : 1, times.size());
        for (Index k = 0; k < times.size(); ++k) {
            const DeflectionAt tip = solution.u(1.0, times(k));
            values(0, k) = tip.xx + zeta * tip.xxt;
            if (solution.sigma)
                values(1, k) = solution.sigma(1.0, times(k)).value;
        }
        return values;
    };
}

/// σ̃, where it is not given and the stops are penalised, is what their law makes of u(1,t).
DifferentiatedSolution with_stress(DifferentiatedSolution solution, const Stops& stops) {
    if (stops.epsilon > 0.0 && !solution.sigma)
        solution.sigma = [u = solution.u, stops](double, double t) -> StressAt {
            return {tvbeam::contact_stress(stops, u(1.0, t).value, 0.0), 0.0};
        };
    return solution;
}

} // namespace

ProblemData differentiated_problem(const DifferentiatedSolution& given, const Beam& beam,
                                   double final_time) {
    const DifferentiatedSolution solution = with_stress(given, beam.stops);
    const auto theta = solution.theta;
    const auto u = solution.u;
    const auto sigma = solution.sigma;
    const double alpha = beam.alpha;
    const double zeta = beam.zeta;
    ProblemData problem;
    problem.heat_source = pointwise([theta, u, alpha](double x, double t) {
        const TemperatureAt here = theta(x, t);
        return here.t - here.xx - alpha * u(x, t).xxt;
    });
    problem.couple_load = pointwise([theta, u, sigma, alpha, zeta](double x, double t) {
        const DeflectionAt here = u(x, t);
        return (sigma ? sigma(x, t).value : 0.0) + here.xxx + zeta * here.xxxt +
               alpha * theta(x, t).x;
    });
    if (sigma)
        problem.body_force = pointwise([sigma](double x, double t) { return sigma(x, t).x; });
    problem.moment_load = moment_load(solution, beam);
    problem.phase_ends = solution.phase_ends;
    std::sort(problem.phase_ends.begin(), problem.phase_ends.end());
    problem.amplitudes = end_values(solution, zeta);
    problem.amplitude_count = sigma ? 2 : 1;
    problem.end_moment = 0;

    problem.exact = exact_solution(solution);
    if (sigma)
        problem.exact->stress = 1;
    problem.theta_initial = problem.exact->theta;
    problem.curvature_initial = problem.exact->u_xx;
    const Admissible admissible = require_admissible(problem, solution.name, beam, final_time);
    problem.exact->law_distance = admissible.law_distance;
    problem.exact->tip_is_sampled = admissible.tip_is_sampled;
    return problem;
}

} // namespace tvbeam
