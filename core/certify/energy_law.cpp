#include "core/certify/energy_law.hpp"

#include <cmath>
#include <limits>

namespace tvbeam {

EnergyLaw::EnergyLaw(const Beam& beam, const Mesh& mesh, ThermalMass mass, double underflow)
    : beam_(beam), mesh_(mesh), mass_(mass), underflow_(underflow) {}

double EnergyLaw::product(const Eigen::VectorXd& theta, const certify::BrokenLinear& w,
                          const Eigen::VectorXd& other_theta,
                          const certify::BrokenLinear& other_w) const {
    return theta.dot(certify::mass_times(mesh_, mass_, other_theta)) +
           certify::product(mesh_, w, other_w);
}

double EnergyLaw::square(const RecordedState& y) const {
    return product(y.theta, y.w, y.theta, y.w);
}

void EnergyLaw::add(const SolveRecord& record) {
    const Eigen::Index s = mesh_.elements();
    const double c = record.leading;
    const Eigen::VectorXd& theta = record.now.theta;
    Rate rate{c * (theta - record.star.theta), c * (record.now.w - record.star.w)};
    const Eigen::ArrayXd slope = (theta.tail(s) - theta.head(s)).array() / mesh_.lengths;
    const double conduction = (mesh_.lengths * slope.square()).sum();
    // KΘ* is summed as differences of fluxes, node by node.
    const Eigen::VectorXd& before = record.star.theta;
    const Eigen::ArrayXd flux = ((before.tail(s) - before.head(s)).array() / mesh_.lengths).abs();
    const double fluxes =
        (flux * (theta.head(s).array().abs() + theta.tail(s).array().abs())).sum();
    const double viscosity = beam_.zeta * certify::product(mesh_, rate.w, rate.w);
    const double heating = record.heat_load.dot(theta);
    const double load = certify::product(mesh_, record.moment, rate.w);
    const double theta_A = beam_.alpha * beam_.theta_A / record.unit;
    const double tip = certify::product(mesh_, certify::moment_arm(mesh_), rate.w);
    balances_.push_back(conduction + viscosity - heating + load + (theta_A - record.stress) * tip);

    // |ẇ| ≤ c (|w| + |w*|) term by term.
    const double rate_size =
        c * (record.now.curvature_size + record.star.curvature_size + underflow_);
    const double forces = beam_.alpha * record.now.temperature_size +
                          record.moment.abs().maxCoeff() + std::abs(theta_A) +
                          std::abs(record.stress) +
                          beam_.zeta * std::sqrt(certify::product(mesh_, rate.w, rate.w));
    sizes_.push_back(conduction + fluxes + viscosity +
                     (c + 4.0 / mesh_.lengths.square().minCoeff()) * record.now.temperature_size *
                         underflow_ +
                     record.heat_load.cwiseAbs().dot(theta.cwiseAbs()) + forces * rate_size);
    rates_.push_back(std::move(rate));
}

double EnergyLaw::end_step(const SolveRecorder& recorder, const SolveRecord& last) {
    const RecordedState& now = last.now;
    const RecordedState& before = recorder.before();
    double change = 0.0;
    double size = 0.0;
    const StatedStep& step = last.step;
    if (static_cast<Eigen::Index>(rates_.size()) != step.solves()) {
        change = std::numeric_limits<double>::infinity();
        size = 1.0;
    } else if (!step.two_step) {
        const Eigen::MatrixXd m = step.algebraic_stability();
        energy_ = 0.5 * square(now);
        const double energy_before = 0.5 * square(before);
        change = energy_ - energy_before;
        size = energy_ + energy_before;
        for (std::size_t i = 0; i < rates_.size(); ++i) {
            const double weight = last.dt * step.a(step.solves() - 1, static_cast<Eigen::Index>(i));
            change += weight * balances_[i];
            size += std::abs(weight) * sizes_[i];
            for (std::size_t j = 0; j < rates_.size(); ++j) {
                const double half = 0.5 * last.dt * last.dt *
                                    m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                const double dissipated =
                    half * product(rates_[i].theta, rates_[i].w, rates_[j].theta, rates_[j].w);
                change += dissipated;
                size += std::abs(dissipated);
            }
        }
    } else {
        // One stage, b = 1, and the form of ẏ in y^n, y^{n−1}, y^{n−2} is its G-norm's.
        const RecordedState& earlier = recorder.before(2);
        const auto combined = [&](double a, double b, double c) {
            const Eigen::VectorXd theta = a * now.theta + b * before.theta + c * earlier.theta;
            const certify::BrokenLinear w = a * now.w + b * before.w + c * earlier.w;
            return product(theta, w, theta, w);
        };
        energy_ = 0.25 * (square(now) + combined(2.0, -1.0, 0.0));
        const double energy_before = 0.25 * (square(before) + combined(0.0, 2.0, -1.0));
        const double dissipated = 0.25 * combined(1.0, -2.0, 1.0);
        change = energy_ - energy_before + dissipated + last.dt * balances_.front();
        size = energy_ + energy_before + dissipated + last.dt * sizes_.front();
    }
    rates_.clear();
    balances_.clear();
    sizes_.clear();
    return change == 0.0 ? 0.0 : std::abs(change) / size;
}

} // namespace tvbeam
