#include "core/certify/energy_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tvbeam {

namespace {

/// Also where its square is beyond the range of doubles.
template <typename Values>
double norm_of(const Mesh& mesh, const Values& values) {
    constexpr double least = std::numeric_limits<double>::min();
    constexpr double with_digits = least / std::numeric_limits<double>::epsilon();
    const double square = certify::product(mesh, values, values);
    if (square >= with_digits && std::isfinite(square))
        return std::sqrt(square);
    const double largest = values.abs().maxCoeff();
    if (!(largest >= least))
        return 0.0;
    return largest * std::sqrt(certify::product(mesh, values / largest, values / largest));
}

} // namespace

EnergyLaw::EnergyLaw(const Beam& beam, const Mesh& mesh, ThermalMass mass, double underflow)
    : beam_(beam), mesh_(mesh), mass_(mass), underflow_(underflow) {}

double EnergyLaw::square(const RecordedState& y) const {
    return certify::mass_product(mesh_, mass_, y.theta, y.theta) +
           certify::product(mesh_, y.w, y.w);
}

void EnergyLaw::add(const SolveRecord& record) {
    const Eigen::Index s = mesh_.elements();
    const double c = record.leading;
    const double dt = record.dt;
    // All times Δt, and ẇ = c (w − w*) next to w − w*: ẇ² alone, or (w − w*)², is beyond the range
    // of doubles where Δt < 1e-154; c Δt is 1 to 4.
    const double c_dt = c * dt;
    const Eigen::VectorXd& theta = record.now.theta;
    const auto change = record.now.w - record.star.w; // c times this is ẇ
    // Without temporaries, here and below: on the largest meshes memory is what takes time.
    const double conduction =
        dt *
        (((theta.tail(s) - theta.head(s)).array() / mesh_.lengths).square() * mesh_.lengths).sum();
    // KΘ* is summed as differences of fluxes, node by node.
    const Eigen::VectorXd& before = record.star.theta;
    const double fluxes = dt * (((before.tail(s) - before.head(s)).array() / mesh_.lengths).abs() *
                                (theta.head(s).array().abs() + theta.tail(s).array().abs()))
                                   .sum();
    const double moved = norm_of(mesh_, change); // ‖w − w*‖
    const double viscosity = beam_.zeta * moved * c_dt * (c * moved);
    const double heating = dt * record.heat_load.dot(theta);
    const double load = c_dt * certify::product(mesh_, record.moment, change);
    const double theta_A = beam_.alpha * beam_.theta_A / record.unit;
    const double tip = c_dt * certify::tip_moment(mesh_, change);
    spent_ += conduction + viscosity;
    balances_.push_back(conduction + viscosity - heating + load + (theta_A - record.stress) * tip);

    // |ẇ| ≤ c (|w| + |w*|) term by term.
    const double change_size =
        c_dt * (record.now.curvature_size + record.star.curvature_size + underflow_);
    const double forces = beam_.alpha * record.now.temperature_size +
                          record.moment.abs().maxCoeff() + std::abs(theta_A) +
                          std::abs(record.stress) + beam_.zeta * (c * moved);
    sizes_.push_back(conduction + fluxes + viscosity +
                     (c_dt + 4.0 * dt / mesh_.lengths.square().minCoeff()) *
                         record.now.temperature_size * underflow_ +
                     dt * record.heat_load.cwiseAbs().dot(theta.cwiseAbs()) + forces * change_size);
}

/// ½ Σ n_kl (d_k, d_l) with the increments d_k = Y_k − y^{n−1} of the stages: as the rates are
/// Δt ẏ = a⁻¹ d, n = a⁻ᵀ m a⁻¹.
EnergyLaw::Dissipation EnergyLaw::dissipation(const SolveRecorder& recorder,
                                              const StatedStep& step) const {
    const Eigen::MatrixXd inverse = step.a.triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd::Identity(step.solves(), step.solves()));
    const Eigen::MatrixXd n = inverse.transpose() * step.algebraic_stability() * inverse;
    const RecordedState& before = recorder.before();
    Dissipation all;
    for (Eigen::Index k = 0; k < step.solves(); ++k) {
        const RecordedState& one = recorder.stage(k);
        for (Eigen::Index l = 0; l <= k; ++l) {
            const RecordedState& other = recorder.stage(l);
            const double term = (k == l ? 0.5 : 1.0) * n(k, l) *
                                (certify::mass_product(mesh_, mass_, one.theta - before.theta,
                                                       other.theta - before.theta) +
                                 certify::product(mesh_, one.w - before.w, other.w - before.w));
            all.sum += term;
            all.size += std::abs(term);
        }
    }
    return all;
}

double EnergyLaw::missed_part() const {
    const double scale = greatest_ + spent_;
    return scale > std::numeric_limits<double>::min() ? std::abs(missed_) / scale : 0.0;
}

double EnergyLaw::end_step(const SolveRecorder& recorder, const SolveRecord& last) {
    const RecordedState& now = last.now;
    const RecordedState& before = recorder.before();
    double change = 0.0;
    double size = 0.0;
    const StatedStep& step = last.step;
    if (static_cast<Eigen::Index>(balances_.size()) != step.solves()) {
        change = std::numeric_limits<double>::infinity();
        size = 1.0;
    } else if (!step.two_step) {
        energy_ = 0.5 * square(now);
        const double energy_before = 0.5 * square(before);
        greatest_ = std::max({greatest_, energy_, energy_before});
        change = energy_ - energy_before;
        size = energy_ + energy_before;
        const Dissipation dissipated = dissipation(recorder, step);
        change += dissipated.sum;
        size += dissipated.size;
        for (Eigen::Index i = 0; i < step.solves(); ++i) {
            const double weight = step.a(step.solves() - 1, i);
            change += weight * balances_[static_cast<std::size_t>(i)];
            size += std::abs(weight) * sizes_[static_cast<std::size_t>(i)];
        }
    } else {
        // One stage, b = 1, and the form of ẏ in y^n, y^{n−1}, y^{n−2} is its G-norm's.
        const RecordedState& earlier = recorder.before(2);
        const auto combined = [&](double a, double b, double c) {
            const auto theta = a * now.theta + b * before.theta + c * earlier.theta;
            const auto w = a * now.w + b * before.w + c * earlier.w;
            return certify::mass_product(mesh_, mass_, theta, theta) +
                   certify::product(mesh_, w, w);
        };
        energy_ = 0.25 * (square(now) + combined(2.0, -1.0, 0.0));
        const double energy_before = 0.25 * (square(before) + combined(0.0, 2.0, -1.0));
        greatest_ = std::max({greatest_, energy_, energy_before});
        const double dissipated = 0.25 * combined(1.0, -2.0, 1.0);
        change = energy_ - energy_before + dissipated + balances_.front();
        size = energy_ + energy_before + dissipated + sizes_.front();
    }
    balances_.clear();
    sizes_.clear();
    // Below this squares have no digits of their own: what has decayed so far is nothing.
    size += std::numeric_limits<double>::min();
    if (std::isinf(size) && now.is_finite())
        throw std::domain_error("the terms of the energy law are beyond the range of floating "
                                "point, and nothing can be certified");
    missed_ += change;
    return std::abs(change) / size;
}

} // namespace tvbeam
