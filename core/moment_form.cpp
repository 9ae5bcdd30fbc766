#include "core/moment_form.hpp"

#include "core/contact/contact.hpp"
#include "core/dense_kernels.hpp"
#include "core/finite.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

namespace tvbeam {

MomentForm::MomentForm(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                       const Scheme& scheme, double dt, const Needs& needs)
    : Solver(scheme.time, dt), beam_(beam), data_(data), mesh_(mesh),
      heat_(needs.temperature || beam.alpha != 0.0),
      bending_(needs.deflection || beam.alpha != 0.0), coupled_(beam.alpha != 0.0),
      stops_(bending_ && beam.stops.exist()), mass_(scheme.thermal_mass) {
    if (heat_) {
        inverse_lengths_ = mesh_.lengths.inverse();
        increment_ = Eigen::VectorXd::Zero(mesh_.elements() - 1);
    }
    lay_out_state();
    load_initial_state();
    load_profiles();
    eliminate(scheme.time.at_step(1).stages.front().leading / dt);
    std::int64_t projected = 0;
    if (needs.curvature && bending_)
        for (std::size_t r = 0; r < data_.profiles.size(); ++r) {
            projections_.push_back(is_bending(static_cast<Eigen::Index>(r))
                                       ? project(mesh_, data_.profiles[r])
                                       : DiscontinuousLinear(2, 0));
            projected += projections_.back().size();
        }
    counters_.doubles_allocated = projected + 2 * factor_.order() + inverse_lengths_.size() +
                                  loads_.size() + arm_load_.size() + response_.size() +
                                  state_.size() + increment_.size() + balance_.size();
}

void MomentForm::lay_out_state() {
    const Eigen::Index s = mesh_.elements();
    const Eigen::Index theta = heat_ ? s + 1 : 0;
    const Eigen::Index nodal = coupled_ ? s + 1 : 0;
    const Eigen::Index weights =
        bending_ ? static_cast<Eigen::Index>(data_.profiles.size()) + 1 : 0;
    const Eigen::Index rest =
        bending_ && (data_.curvature_initial.rest || data_.moment_load.rest) ? s : 0;
    state_ = Eigen::VectorXd::Zero(theta + nodal + weights + 2 * rest);
    double* place = state_.data();
    new (&theta_) SplitCurvature::Vector(place, theta);
    new (&w_.nodal) SplitCurvature::Vector(place += theta, nodal);
    new (&w_.weights) SplitCurvature::Vector(place += nodal, weights);
    new (&w_.rest) Eigen::Map<DiscontinuousLinear>(place + weights, 2, rest);
}

void MomentForm::load_initial_state() {
    Eigen::VectorXd amplitudes;
    if (data_.amplitude_count > 0)
        amplitudes = data_.amplitudes(Eigen::ArrayXd::Zero(1)).col(0).matrix();
    if (heat_) {
        theta_ = (values(data_, data_.theta_initial, mesh_.nodes, 0.0) -
                  beam_.theta_A * (1.0 - mesh_.nodes))
                     .matrix();
        theta_(0) = 0.0;
        theta_(mesh_.elements()) = 0.0;
    }
    if (bending_) {
        for (const auto& term : data_.curvature_initial.terms)
            w_.weights(term.profile) += amplitudes(term.amplitude);
        if (const auto& rest = data_.curvature_initial.rest)
            w_.rest = project(mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, 0.0); });
    }
    if (coupled_)
        balance_ = Eigen::VectorXd::Zero(mesh_.elements() + 1);
}

bool MomentForm::is_bending(Eigen::Index profile) const {
    return data_.moment_load.uses(profile) || data_.curvature_initial.uses(profile);
}

void MomentForm::load_profiles() {
    const Eigen::Index inner = mesh_.elements() - 1;
    const auto arm = static_cast<Eigen::Index>(data_.profiles.size());
    const auto arm_function = [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; };
    const bool arm_used = stops_ || (coupled_ && beam_.theta_A != 0.0);
    const auto bends = [&](Eigen::Index r) {
        return r == arm ? arm_used : bending_ && is_bending(r);
    };
    const auto heats = [&](Eigen::Index r) {
        return r < arm && heat_ && data_.heat_source.uses(r);
    };

    for (Eigen::Index r = 0; r <= arm; ++r)
        if (heats(r) || (bends(r) && coupled_))
            columns_.push_back(r);
    loads_.resize(inner, static_cast<Eigen::Index>(columns_.size()));
    tip_moments_ = Eigen::VectorXd::Zero(arm + 1);
    for (Eigen::Index r = 0, column = 0; r <= arm; ++r) {
        if (!bends(r) && !heats(r))
            continue;
        LoadProfile profile = load_profile(
            mesh_, r == arm ? arm_function : data_.profiles[static_cast<std::size_t>(r)]);
        tip_moments_(r) = profile.tip_moment;
        if (r == arm && stops_)
            arm_load_ = profile.hat_load;
        if (column < loads_.cols() && columns_[static_cast<std::size_t>(column)] == r)
            loads_.col(column++) = profile.hat_load.segment(1, inner);
    }
    load_weights_ = tip_moments_;
}

/// The matrix of a solve with the coefficient c, factored, and what answers λ = 1.
void MomentForm::eliminate(double c) {
    leading_ = c;
    kappa_ = 1.0 / (1.0 + beam_.zeta * leading_);
    if (heat_) {
        factor_ = {};
        Tridiagonal matrix = thermal_mass_matrix(mesh_, mass_) * leading_ + stiffness_matrix(mesh_);
        if (coupled_)
            matrix = std::move(matrix) + thermal_mass_matrix(mesh_, ThermalMass::consistent) *
                                             (beam_.alpha * beam_.alpha * leading_ * kappa_);
        factor_ = TridiagonalFactor(matrix, Elimination::from_both_ends);
    }
    if (stops_)
        find_contact_response();
}

void MomentForm::find_contact_response() {
    compliance_ = kappa_ / 3.0; // ∫ (1 − x)² dx = 1/3
    if (!coupled_)
        return;
    const Eigen::Index inner = mesh_.elements() - 1;
    response_ = Eigen::VectorXd::Zero(mesh_.elements() + 1);
    response_.segment(1, inner) = beam_.alpha * leading_ * kappa_ * arm_load_.segment(1, inner);
    factor_.solve_in_place(response_.segment(1, inner));
    compliance_ -= kappa_ * beam_.alpha * response_.dot(arm_load_);
}

std::string MomentForm::solve(double c, double t,
                              const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
    if (c != leading_)
        eliminate(c);
    DiscontinuousLinear rest_change;
    if (bending_) {
        // −κ (w* + Πμ), part by part; the nodal part follows with the temperature.
        weight_changes_ = w_.weights;
        for (const auto& term : data_.moment_load.terms)
            weight_changes_(term.profile) += amplitudes(term.amplitude);
        if (coupled_)
            weight_changes_.tail<1>()(0) += beam_.alpha * beam_.theta_A;
        weight_changes_ *= -kappa_;
        if (w_.rest.size() > 0) {
            rest_change = w_.rest;
            if (const auto& rest = data_.moment_load.rest) {
                rest_change += project(mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, t); });
                ++counters_.source_evaluations;
            }
            rest_change *= -kappa_;
        }
        ++counters_.beam_solves;
    }
    if (heat_)
        solve_heat(t, amplitudes, rest_change);
    if (bending_) {
        w_.weights += weight_changes_;
        if (w_.rest.size() > 0)
            w_.rest += rest_change;
    }
    if (stops_)
        make_contact();
    if (!data_.heat_source.is_zero() || !data_.moment_load.is_zero())
        ++counters_.load_updates;

    if (heat_ && !are_finite(increment_))
        return "the temperature is not finite";
    if (bending_ && !(w_.weights.allFinite() && std::isfinite(stress_) && are_finite(w_.rest)))
        return "the curvature is not finite";
    return {};
}

void MomentForm::solve_heat(double t, const Eigen::Ref<const Eigen::VectorXd>& amplitudes,
                            const DiscontinuousLinear& rest_change) {
    const Eigen::Index s = mesh_.elements();
    const Eigen::Index inner = s - 1;
    const auto theta = theta_.array();
    auto rhs = increment_.array();
    // −KΘ* as differences of fluxes: the differences of neighbours are exact in floating point.
    rhs = (theta.tail(inner) - theta.segment(1, inner)) * inverse_lengths_.tail(inner) -
          (theta.segment(1, inner) - theta.head(inner)) * inverse_lengths_.head(inner);
    const double exchange = beam_.alpha * leading_; // α c
    if (coupled_) {
        balance_ = w_.nodal + beam_.alpha * theta_;
        const auto v = balance_.array();
        const auto& h = mesh_.lengths;
        rhs -= exchange * kappa_ / 6.0 *
               (h.head(inner) * (v.head(inner) + 2.0 * v.segment(1, inner)) +
                h.tail(inner) * (2.0 * v.segment(1, inner) + v.tail(inner)));
        if (rest_change.size() > 0)
            rhs += exchange * hat_loads(mesh_, rest_change).segment(1, inner).array();
        ++counters_.coupling_updates;
    }
    if (loads_.cols() > 0) {
        load_weights_.setZero();
        for (const auto& term : data_.heat_source.terms)
            load_weights_(term.profile) += amplitudes(term.amplitude);
        if (coupled_)
            load_weights_ += exchange * weight_changes_;
        column_weights_ = load_weights_(columns_);
        add_product(increment_, loads_, column_weights_, inner);
    }
    if (const auto& rest = data_.heat_source.rest) {
        increment_ +=
            hat_loads(mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, t); }).segment(1, inner);
        ++counters_.source_evaluations;
    }
    factor_.solve_in_place(increment_);
    ++counters_.heat_solves;
    theta_.segment(1, inner) += increment_;
    if (coupled_)
        w_.nodal.segment(1, inner) -=
            kappa_ * (balance_.segment(1, inner) + beam_.alpha * increment_);
}

void MomentForm::make_contact() {
    stress_ = tvbeam::contact_stress(beam_.stops, tip_displacement(), compliance_);
    ++counters_.tip_evaluations;
    if (stress_ == 0.0)
        return;
    w_.weights.tail<1>()(0) += kappa_ * stress_;
    if (coupled_) {
        theta_ += stress_ * response_;
        w_.nodal -= (kappa_ * beam_.alpha * stress_) * response_;
    }
}

double MomentForm::tip_displacement() const {
    double tip = w_.weights.dot(tip_moments_);
    if (coupled_)
        tip += arm_load_.size() > 0
                   ? w_.nodal.dot(arm_load_)
                   : w_.nodal.dot(hat_loads(
                         mesh_, [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd { return 1.0 - x; }));
    if (w_.rest.size() > 0)
        tip += tip_moment(mesh_, w_.rest);
    return tip;
}

DiscontinuousLinear MomentForm::curvature() const {
    const Eigen::Index s = mesh_.elements();
    DiscontinuousLinear w = DiscontinuousLinear::Zero(2, s);
    if (w_.rest.size() > 0)
        w = w_.rest;
    for (std::size_t r = 0; r < data_.profiles.size(); ++r) {
        const double weight = w_.weights(static_cast<Eigen::Index>(r));
        if (weight != 0.0 && projections_.empty())
            w += weight * project(mesh_, data_.profiles[r]);
        else if (weight != 0.0)
            w += weight * projections_[r];
    }
    for (const Eigen::Index end : {Eigen::Index{0}, Eigen::Index{1}}) { // of every element
        const auto moment = w_.weights.tail<1>()(0) * (1.0 - mesh_.nodes.segment(end, s));
        if (coupled_) // one may be nearly minus the other
            w.row(end) += (moment + w_.nodal.segment(end, s).array()).transpose();
        else
            w.row(end) += moment.transpose();
    }
    return w;
}

} // namespace tvbeam
