#include "core/hermite_form.hpp"

#include "core/contact/contact.hpp"
#include "core/contraction.hpp"
#include "core/finite.hpp"
#include "core/space/cells.hpp"
#include "core/space/quadrature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <stdexcept>

namespace tvbeam {

namespace {

/// Derivatives 0, 1, 2 in x of the four Hermite cubics of an element of length h, at ξ in [0, 1]:
/// value left, slope left, value right, slope right.
std::array<double, 4> cubics(double xi, double h, int derivative) {
    switch (derivative) {
    case 0:
        return {1.0 + xi * xi * (2.0 * xi - 3.0), h * xi * (1.0 - xi) * (1.0 - xi),
                xi * xi * (3.0 - 2.0 * xi), h * xi * xi * (xi - 1.0)};
    case 1:
        return {6.0 * xi * (xi - 1.0) / h, (1.0 - xi) * (1.0 - 3.0 * xi), 6.0 * xi * (1.0 - xi) / h,
                xi * (3.0 * xi - 2.0)};
    default:
        return {(12.0 * xi - 6.0) / (h * h), (6.0 * xi - 4.0) / h, (6.0 - 12.0 * xi) / (h * h),
                (6.0 * xi - 2.0) / h};
    }
}

/// Row of d that belongs to local cubic k of element j; negative at the clamped end (5).
Eigen::Index unknown(Eigen::Index element, int k) {
    return 2 * element - 2 + k;
}

/// (g, η_j^{(derivative)}); shape: 2s
Eigen::VectorXd cubic_loads(const Mesh& mesh, const SpaceFunction& g, int derivative) {
    const GaussRule& rule = element_rule();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(2 * mesh.elements());
    for_each_block(mesh, [&](Eigen::Index first, Eigen::Index count) {
        const Eigen::ArrayXXd values = at_points(g, element_points(mesh, first, count));
        const CellRange block = cells_of(mesh, first, count);
        for (Eigen::Index e = first; e < first + count; ++e) {
            const double h = mesh.lengths(e);
            const CellRange cells = cells_of(mesh, e, 1);
            for (Eigen::Index c = cells.first; c < cells.first + cells.count; ++c)
                for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
                    const auto eta = cubics(in_element(mesh, c, rule.points(q)), h, derivative);
                    const double weight = integration_mesh(mesh).lengths(c) * rule.weights(q);
                    for (int k = 0; k < 4; ++k)
                        if (const Eigen::Index row = unknown(e, k); row >= 0)
                            loads(row) += weight * values(q, c - block.first) *
                                          eta[static_cast<std::size_t>(k)];
                }
        }
    });
    return loads;
}

} // namespace

HermiteForm::HermiteForm(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                         const Scheme& scheme, double dt)
    : Solver(scheme.time, dt), beam_(beam), data_(data), mesh_(mesh),
      mass_kind_(scheme.thermal_mass), tolerance_(scheme.tolerance) {
    assemble();
    factor(scheme.time.at_step(1).stages.front().leading / dt);
    const Eigen::Index inner = mesh_.elements() - 1;
    loads_.resize(data_.profiles.size());
    for (std::size_t r = 0; r < loads_.size(); ++r) {
        const auto index = static_cast<Eigen::Index>(r);
        if (data_.heat_source.uses(index))
            loads_[r].hat = hat_loads(mesh_, data_.profiles[r]).segment(1, inner);
        if (data_.couple_load.uses(index))
            loads_[r].slope = cubic_loads(mesh_, data_.profiles[r], 1);
        if (data_.body_force.uses(index))
            loads_[r].value = cubic_loads(mesh_, data_.profiles[r], 0);
        counters_.doubles_allocated +=
            loads_[r].hat.size() + loads_[r].slope.size() + loads_[r].value.size();
    }
    project_initial_state();
    counters_.doubles_allocated += 2 * inner + bending_.nonZeros() + coupling_.nonZeros() +
                                   theta_.size() + deflection_.size() + tip_response_.size();
}

void HermiteForm::assemble() {
    const Eigen::Index s = mesh_.elements();
    mass_ = thermal_mass_matrix(mesh_, mass_kind_);

    // Entries in closed form, not by quadrature: the rows of B then annihilate rigid motions as
    // well as floating point allows, and the round-off of the method is no larger than it must be.
    std::vector<Eigen::Triplet<double>> b;
    std::vector<Eigen::Triplet<double>> c;
    for (Eigen::Index j = 0; j < s; ++j) {
        // Of a uniform mesh 1/h is an integer, and so is every entry: no entry is rounded.
        const double k1 = 1.0 / mesh_.lengths(j);
        const double k2 = k1 * k1;
        const double k3 = k2 * k1;
        Eigen::Matrix4d element;
        element << 12.0 * k3, 6.0 * k2, -12.0 * k3, 6.0 * k2, //
            6.0 * k2, 4.0 * k1, -6.0 * k2, 2.0 * k1,          //
            -12.0 * k3, -6.0 * k2, 12.0 * k3, -6.0 * k2,      //
            6.0 * k2, 2.0 * k1, -6.0 * k2, 4.0 * k1;
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < 4; ++l)
                if (unknown(j, k) >= 0 && unknown(j, l) >= 0)
                    b.emplace_back(unknown(j, k), unknown(j, l), element(k, l));
        // χ' is ∓1/h on the element, and ∫ η' is the difference of the values at its ends.
        for (int side = 0; side < 2; ++side)
            for (const int l : {0, 2})
                if (const Eigen::Index row = j - 1 + side;
                    row >= 0 && row < s - 1 && unknown(j, l) >= 0)
                    c.emplace_back(row, unknown(j, l), (side == 0) == (l == 0) ? k1 : -k1);
    }
    bending_.resize(2 * s, 2 * s);
    bending_.setFromTriplets(b.begin(), b.end());
    coupling_.resize(s - 1, 2 * s);
    coupling_.setFromTriplets(c.begin(), c.end());
    bending_factor_.compute(bending_);
    if (bending_factor_.info() != Eigen::Success)
        throw std::domain_error(
            "the matrix B of the Hermite cubics is not positive definite in "
            "floating point: its condition grows like h^-4; use the direct algorithm");
}

/// What depends on the coefficient c of a solve.
void HermiteForm::factor(double c) {
    ++factorizations_;
    leading_ = c;
    dt_ = 1.0 / c;
    heat_ = TridiagonalFactor(mass_ + stiffness_matrix(mesh_) * dt_);
    Eigen::VectorXd tip = Eigen::VectorXd::Zero(2 * mesh_.elements());
    tip(tip.size() - 2) = dt_ / (dt_ + beam_.zeta);
    tip_response_ = bending_factor_.solve(tip);
}

void HermiteForm::project_initial_state() {
    const Eigen::Index s = mesh_.elements();
    state_ = Eigen::VectorXd::Zero(3 * s + 1);
    new (&theta_) Eigen::Map<Eigen::VectorXd>(state_.data(), s + 1);
    new (&deflection_) Eigen::Map<Eigen::VectorXd>(state_.data() + s + 1, 2 * s);
    theta_ =
        (values(data_, data_.theta_initial, mesh_.nodes, 0.0) - beam_.theta_A * (1.0 - mesh_.nodes))
            .matrix();
    theta_(0) = 0.0;
    theta_(s) = 0.0;
    const SpaceFunction curvature = [this](const Eigen::ArrayXd& x) {
        return values(data_, data_.curvature_initial, x, 0.0);
    };
    deflection_ = bending_factor_.solve(cubic_loads(mesh_, curvature, 2));
}

Eigen::VectorXd HermiteForm::heat_load(double t,
                                       const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
    const Eigen::Index inner = mesh_.elements() - 1;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(inner);
    for (const auto& term : data_.heat_source.terms)
        load += amplitudes(term.amplitude) * loads_[static_cast<std::size_t>(term.profile)].hat;
    if (const auto& rest = data_.heat_source.rest) {
        load +=
            hat_loads(mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, t); }).segment(1, inner);
        ++counters_.source_evaluations;
    }
    return load;
}

Eigen::VectorXd HermiteForm::beam_load(double t,
                                       const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
    const Eigen::Index s = mesh_.elements();
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * s);
    for (const auto& term : data_.couple_load.terms)
        load -= amplitudes(term.amplitude) * loads_[static_cast<std::size_t>(term.profile)].slope;
    for (const auto& term : data_.body_force.terms)
        load -= amplitudes(term.amplitude) * loads_[static_cast<std::size_t>(term.profile)].value;
    if (const auto& rest = data_.couple_load.rest) {
        load -= cubic_loads(
            mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, t); }, 1);
        ++counters_.source_evaluations;
    }
    if (const auto& rest = data_.body_force.rest) {
        load -= cubic_loads(
            mesh_, [&](const Eigen::ArrayXd& x) { return rest(x, t); }, 0);
        ++counters_.source_evaluations;
    }
    if (data_.end_moment)
        load(2 * s - 1) += amplitudes(*data_.end_moment);
    load(2 * s - 2) -= beam_.alpha * beam_.theta_A;
    return load;
}

std::string HermiteForm::predicted() const {
    const double rho = contraction(beam_, mesh_, mass_kind_, leading_);
    return rho < 1.0 ? ""
                     : fmt::format("; where nothing holds the tip, each iteration multiplies the "
                                   "error by {:.3g}, predicted",
                                   rho);
}

std::string HermiteForm::solve(double c, double t,
                               const Eigen::Ref<const Eigen::VectorXd>& amplitudes) {
    if (c != leading_)
        factor(c);
    const Eigen::Index s = mesh_.elements();
    const Eigen::Index inner = s - 1;
    const Eigen::Index tip = 2 * s - 2;

    const Eigen::VectorXd deflection_before = deflection_;
    const Eigen::VectorXd heat_constant =
        mass_ * theta_.segment(1, inner).eval() + dt_ * heat_load(t, amplitudes);
    const Eigen::VectorXd beam_constant =
        beam_.zeta * (bending_ * deflection_before) + dt_ * beam_load(t, amplitudes);
    if (!data_.heat_source.is_zero() || !data_.couple_load.is_zero() || !data_.body_force.is_zero())
        ++counters_.load_updates;

    // With α = 0 the two problems do not wait for each other: one pass solves both.
    const bool coupled = beam_.alpha != 0.0;
    double change = 0.0;
    changes_.clear();
    for (int iteration = 1; iteration <= iteration_limit; ++iteration) {
        ++counters_.fixed_point_iterations;
        Eigen::VectorXd theta = heat_constant;
        if (coupled)
            theta += beam_.alpha * (coupling_ * (deflection_before - deflection_));
        heat_.solve_in_place(theta);
        ++counters_.heat_solves;

        Eigen::VectorXd load = beam_constant;
        if (coupled) {
            load += beam_.alpha * dt_ * (coupling_.transpose() * theta);
            ++counters_.coupling_updates;
        }
        Eigen::VectorXd next = bending_factor_.solve(load) / (dt_ + beam_.zeta);
        ++counters_.beam_solves;
        if (beam_.stops.exist()) {
            stress_ = tvbeam::contact_stress(beam_.stops, next(tip), tip_response_(tip));
            next += stress_ * tip_response_;
            ++counters_.tip_evaluations;
        }
        change = 0.0;
        if (inner > 0)
            change = (theta - theta_.segment(1, inner)).cwiseAbs().maxCoeff();
        changes_.push_back(change);
        for (Eigen::Index i = 0; i < 2 * s; i += 2)
            change = std::max(change, std::abs(next(i) - deflection_(i)));
        theta_.segment(1, inner) = theta;
        deflection_ = next;
        if (!are_finite(theta) || !are_finite(next))
            return coupled ? fmt::format("the fixed-point iteration diverges: not finite after {} "
                                         "iteration{}{}",
                                         iteration, iteration == 1 ? "" : "s", predicted())
                           : "the temperature or the deflection is not finite";
        if (!coupled || change <= tolerance_)
            return {};
    }
    return fmt::format("the fixed-point iteration does not reach its tolerance {:g}: after {} "
                       "iterations a nodal value still changes by {:g}{}; use the direct algorithm",
                       tolerance_, iteration_limit, change, predicted());
}

double HermiteForm::tip_displacement() const {
    return deflection_(deflection_.size() - 2);
}

Deflection HermiteForm::nodal_deflection() const {
    const Eigen::Index s = mesh_.elements();
    Deflection nodal{Eigen::VectorXd::Zero(s + 1), Eigen::VectorXd::Zero(s + 1)};
    for (Eigen::Index j = 1; j <= s; ++j) {
        nodal.value(j) = deflection_(2 * j - 2);
        nodal.slope(j) = deflection_(2 * j - 1);
    }
    return nodal;
}

DiscontinuousLinear HermiteForm::curvature() const {
    return tvbeam::curvature(mesh_, nodal_deflection());
}

} // namespace tvbeam
