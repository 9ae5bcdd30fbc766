#include "core/certify/residuals.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace tvbeam {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// residual/(ε·size), where 0/0 is none; of a state that is no number neither is that.
double in_round_off(double residual, double size, const RecordedState& now) {
    if (std::isinf(size) && now.is_finite())
        throw std::domain_error("the terms of the discrete equations are beyond the range of "
                                "floating point, and nothing can be certified");
    return residual == 0.0 ? 0.0 : residual / (epsilon * size);
}

double heat_residual(const Beam& beam, const Mesh& mesh, ThermalMass mass,
                     const SolveRecord& record, double underflow) {
    const Eigen::Index s = mesh.elements();
    const Eigen::Index inner = s - 1;
    if (inner == 0)
        return 0.0;
    const double c = record.leading;
    const Eigen::VectorXd& theta = record.now.theta;
    if (theta(0) != 0.0 || theta(s) != 0.0) // (9), (10)
        return std::numeric_limits<double>::infinity();
    const auto increment = (theta - record.star.theta).array();
    const auto bent = record.now.w - record.star.w;
    const auto flux = (theta.tail(s) - theta.head(s)).array() / mesh.lengths; // Θ_x
    const auto coupling =
        certify::hat_loads(mesh, bent.row(0).transpose(), bent.row(1).transpose());
    const auto largest = [&](const auto& storage) {
        return (c * storage + flux.head(inner) - flux.tail(inner) - (beam.alpha * c) * coupling -
                record.heat_load.segment(1, inner).array())
            .abs()
            .template maxCoeff<Eigen::PropagateNaN>();
    };
    const double residual =
        mass == ThermalMass::consistent
            ? largest(certify::hat_loads(mesh, increment.head(s), increment.tail(s)))
            : largest((mesh.lengths.tail(inner) / 2.0 + mesh.lengths.head(inner) / 2.0) *
                      increment.segment(1, inner));
    const double temperature = record.now.temperature_size + underflow;
    const double h = mesh.lengths.maxCoeff();
    const double size =
        c * h * temperature + 4.0 / mesh.lengths.minCoeff() * temperature +
        beam.alpha * c * h * (record.now.curvature_size + record.star.curvature_size + underflow) +
        record.heat_load.cwiseAbs().maxCoeff() + underflow;
    return in_round_off(residual, size, record.now);
}

double beam_residual(const Beam& beam, const Mesh& mesh, const SolveRecord& record,
                     double underflow, double unit_theta_A) {
    const double viscous = beam.zeta * record.leading;
    const double force = beam.alpha * unit_theta_A - record.stress;
    const Eigen::Index s = mesh.elements();
    Eigen::Array2d largest;
    for (const Eigen::Index end : {Eigen::Index{0}, Eigen::Index{1}}) { // of every element
        const auto w = record.now.w.row(end);
        const auto theta = record.now.theta.segment(end, s).transpose().array();
        const auto arm = (1.0 - mesh.nodes.segment(end, s)).transpose();
        const auto residual = w + viscous * (w - record.star.w.row(end)) + record.moment.row(end) +
                              beam.alpha * theta + force * arm;
        largest(end) = residual.abs().maxCoeff<Eigen::PropagateNaN>();
    }
    const double now = record.now.curvature_size + underflow;
    const double size = now + viscous * (now + record.star.curvature_size + underflow) +
                        beam.alpha * (record.now.temperature_size + std::abs(unit_theta_A)) +
                        record.moment.abs().maxCoeff() + std::abs(record.stress) + underflow;
    return in_round_off(largest.maxCoeff<Eigen::PropagateNaN>(), size, record.now);
}

} // namespace

Residuals residuals(const Beam& beam, const Mesh& mesh, ThermalMass mass, const SolveRecord& record,
                    double underflow) {
    return {heat_residual(beam, mesh, mass, record, underflow),
            beam_residual(beam, mesh, record, underflow, beam.theta_A / record.unit)};
}

} // namespace tvbeam
