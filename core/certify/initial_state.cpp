#include "core/certify/initial_state.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

Eigen::ArrayXd at_start(const ProblemData& data, const Field& field, const Eigen::ArrayXd& x) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(x.size());
    if (field.rest)
        sum += field.rest(x, 0.0);
    if (field.terms.empty())
        return sum;
    const Eigen::ArrayXXd amplitudes = data.amplitudes(Eigen::ArrayXd::Zero(1));
    for (const auto& term : field.terms)
        sum += amplitudes(term.amplitude, 0) *
               data.profiles[static_cast<std::size_t>(term.profile)](x);
    return sum;
}

} // namespace

double initial_defect(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                      const RecordOptions& options, const SolverState& initial) {
    const Eigen::Index s = mesh.elements();
    const Eigen::ArrayXd temperature = at_start(data, data.theta_initial, mesh.nodes);
    Eigen::ArrayXd theta = temperature - beam.theta_A * (1.0 - mesh.nodes);
    theta(0) = 0.0;
    theta(s) = 0.0;
    const auto w = certify::load_of(mesh, [&](const Eigen::ArrayXd& x) {
                       return at_start(data, data.curvature_initial, x);
                   }).projection;
    const auto largest = [](const auto& values) {
        return values.abs().template maxCoeff<Eigen::PropagateNaN>();
    };
    // 0/0 is none.
    const auto part = [](double difference, double size) {
        return difference == 0.0 ? 0.0 : difference / size;
    };
    const double heat =
        part(largest(initial.theta.array() - theta), largest(temperature) + std::abs(beam.theta_A));
    const double bend =
        part(largest(initial.w - w), std::max(largest(w), options.least_size * options.unit));
    return heat > bend || std::isnan(heat) ? heat : bend;
}

} // namespace tvbeam
