#include "core/sine/errors.hpp"

#include "core/dense_kernels.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

Eigen::MatrixXd by_profile(const Field& field, Eigen::Index amplitudes, Eigen::Index rows) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(amplitudes, rows);
    for (const auto& term : field.terms)
        matrix(term.amplitude, term.profile) += 1.0;
    return matrix;
}

SineErrors::SineErrors(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                       const SineBasis& basis, const SineProfiles& profiles,
                       const std::vector<Norm>& norms, bool coupled, Eigen::Index most_steps)
    : sums_(norms), profiles_(profiles), stress_(data.exact ? data.exact->stress : std::nullopt),
      theta_A_(beam.theta_A), coupled_(coupled), most_steps_(most_steps) {
    prepare_temperature(data, mesh, basis);
    prepare_curvature(data, mesh, basis);
}

void SineErrors::prepare_temperature(const ProblemData& data, const Mesh& mesh,
                                     const SineBasis& basis) {
    const Eigen::Index rows = profiles_.expansion.cols();
    if (needs(Quantity::theta)) {
        exact_temperature_ = -by_profile(data.exact->theta, data.amplitude_count, rows) *
                             profiles_.expansion.transpose();
        temperature_at_ends_ =
            theta_A_ != 0.0 || (exact_temperature_.leftCols(profiles_.linear).array() != 0.0).any();
        temperature_weights_ = TimeSeries::Zero(most_steps_, profiles_.columns());
        SineSquare square = square_of(temperature_weights_);
        square.first_column = temperature_at_ends_ ? 0 : profiles_.linear;
        add_square(temperature_squares_, Quantity::theta, square);
    }
    if (needs(Quantity::theta_x)) {
        slope_.emplace(data, mesh, basis);
        exact_slope_ = -by_profile(data.exact->theta_x, data.amplitude_count,
                                   rows)(Eigen::all, slope_->profiles);
        slope_weights_ =
            TimeSeries::Zero(most_steps_, static_cast<Eigen::Index>(slope_->profiles.size()));
        add_square(temperature_squares_, Quantity::theta_x, square_of(*slope_, slope_weights_));
    }
}

void SineErrors::prepare_curvature(const ProblemData& data, const Mesh& mesh,
                                   const SineBasis& basis) {
    const bool integrates = needs(Quantity::u) || needs(Quantity::u_x);
    if (!integrates && !needs(Quantity::u_xx))
        return;
    const Eigen::Index rows = profiles_.expansion.cols();
    const Eigen::MatrixXd columns = profiles_.expansion.transpose();
    exact_curvature_ = -by_profile(data.exact->u_xx, data.amplitude_count, rows) * columns;
    weight_columns_ = columns;
    curvature_weights_ = TimeSeries::Zero(most_steps_, profiles_.columns());
    if (needs(Quantity::u_xx)) {
        curvature_form_ = profiles_.remainder - profiles_.projection;
        // Without coupling a is zero, and the sum over the modes a form in v too.
        if (!coupled_)
            curvature_form_ += profiles_.modes_gram;
        if (!profiles_.projection.isZero(0.0))
            outside_form_ = exact_curvature_ * profiles_.projection * exact_curvature_.transpose();
        if (coupled_)
            add_square(curvature_squares_, Quantity::u_xx, square_of(curvature_weights_));
    }
    if (!integrates)
        return;
    deflection_.emplace(profiles_, mesh, basis, coupled_);
    deflection_weights_ = TimeSeries::Zero(most_steps_, profiles_.columns() + deflection_->outside);
    if (!coupled_)
        return;
    if (needs(Quantity::u_x))
        add_square(curvature_squares_, Quantity::u_x,
                   square_of(deflection_->slope, deflection_weights_));
    if (needs(Quantity::u)) {
        SineSquare square = square_of(deflection_->value, deflection_weights_);
        moments_.resize(static_cast<std::size_t>(most_steps_));
        square.arm = deflection_->arm.data();
        square.moments = moments_.data();
        add_square(curvature_squares_, Quantity::u, square);
    }
}

SineSquare SineErrors::square_of(const SineTable& table, const TimeSeries& weights) const {
    SineSquare square;
    square.factors = table.factors.data();
    square.table = table.table.data();
    square.active_columns = table.active.data();
    square.weights = weights.data();
    square.weight_stride = most_steps_;
    return square;
}

SineSquare SineErrors::square_of(const TimeSeries& weights) const {
    SineSquare square;
    square.table = profiles_.table.data();
    square.active_columns = profiles_.active.data();
    square.weights = weights.data();
    square.weight_stride = most_steps_;
    return square;
}

void SineErrors::add_square(std::vector<SineSquare>& squares, Quantity quantity,
                            SineSquare square) {
    PackSums& packs = packs_[index(quantity)];
    packs.resize(static_cast<std::size_t>(most_steps_));
    square.squares = packs.data();
    squares.push_back(square);
}

std::span<const SineSquare> SineErrors::temperature_squares() {
    for (const Quantity quantity : {Quantity::theta, Quantity::theta_x})
        std::fill(packs_[index(quantity)].begin(), packs_[index(quantity)].end(), Pack{});
    return temperature_squares_;
}

std::span<const SineSquare> SineErrors::curvature_squares() {
    for (const Quantity quantity : {Quantity::u, Quantity::u_x, Quantity::u_xx})
        std::fill(packs_[index(quantity)].begin(), packs_[index(quantity)].end(), Pack{});
    std::fill(moments_.begin(), moments_.end(), Pack{});
    return curvature_squares_;
}

void SineErrors::weigh(Eigen::Index steps, const TimeSeries& amplitudes,
                       const TimeSeries& weights) {
    if (needs(Quantity::theta)) {
        temperature_weights_.setZero();
        temperature_weights_.col(0).setConstant(theta_A_);
        add_product(temperature_weights_, amplitudes, exact_temperature_, steps);
    }
    if (slope_) {
        slope_weights_.setZero();
        add_product(slope_weights_, amplitudes, exact_slope_, steps);
    }
    if (curvature_weights_.size() > 0) {
        curvature_weights_.setZero();
        add_product(curvature_weights_, weights, weight_columns_, steps);
        if (deflection_) // −c, while the weights are those of w alone
            deflection_weights_.rightCols(deflection_->outside) =
                -curvature_weights_.rightCols(deflection_->outside);
        add_product(curvature_weights_, amplitudes, exact_curvature_, steps);
        if (deflection_)
            deflection_weights_.leftCols(profiles_.columns()) = curvature_weights_;
    }
}

void SineErrors::add(Eigen::Index steps, double dt, const TimeSeries& amplitudes,
                     const Eigen::VectorXd& tips, const Eigen::VectorXd& stress) {
    for (std::size_t q = 0; q < quantity_count; ++q)
        if (packs_[q].empty())
            totals_[q].setZero(sums_.needed()[q] ? steps : 0);
        else
            find_totals(totals_[q], packs_[q], steps);
    if (needs(Quantity::theta))
        add_forms(of(Quantity::theta), temperature_weights_, profiles_.remainder, steps);
    if (slope_)
        add_slopes_of_temperature(steps);
    if (needs(Quantity::u_xx)) {
        add_forms(of(Quantity::u_xx), curvature_weights_, curvature_form_, steps);
        if (outside_form_.size() > 0)
            add_forms(of(Quantity::u_xx), amplitudes, outside_form_, steps);
    }
    if (deflection_)
        add_deflections(steps, tips);
    // A square that round-off made negative is zero; NaN stays NaN.
    const auto non_negative = [](double square) { return square < 0.0 ? 0.0 : square; };
    for (Eigen::Index n = 0; n < steps; ++n) {
        Squares squares = unmeasured();
        for (std::size_t q = 0; q < quantity_count; ++q)
            if (sums_.needed()[q])
                squares[q] = non_negative(totals_[q](n));
        const double error = stress(n) - (stress_ ? amplitudes(n, *stress_) : 0.0);
        squares[index(Quantity::stress)] = error * error;
        sums_.add(dt, squares);
    }
}

void SineErrors::add_slopes_of_temperature(Eigen::Index steps) {
    Eigen::VectorXd& squares = of(Quantity::theta_x);
    add_forms(squares, slope_weights_, slope_->remainder, steps);
    // The mean, which is that of −θ_A − θ̃_x.
    squares.array() +=
        ((slope_weights_.topRows(steps) * slope_->means).array() - theta_A_).square();
}

void SineErrors::add_deflections(Eigen::Index steps, const Eigen::VectorXd& tips) {
    const Eigen::ArrayXd tip =
        (tips + curvature_weights_.topRows(steps) * deflection_->tip_moments).array();
    if (needs(Quantity::u_x)) {
        Eigen::VectorXd& squares = of(Quantity::u_x);
        add_forms(squares, deflection_weights_, deflection_->slope.remainder, steps);
        squares.array() += tip.square();
    }
    if (needs(Quantity::u)) {
        Eigen::VectorXd& squares = of(Quantity::u);
        add_forms(squares, deflection_weights_, deflection_->value.remainder, steps);
        Eigen::ArrayXd with_arm =
            (deflection_weights_.topRows(steps) * deflection_->arm_rest).array();
        if (!moments_.empty())
            for (Eigen::Index n = 0; n < steps; ++n)
                with_arm(n) += total(moments_[static_cast<std::size_t>(n)]);
        squares.array() += tip * (2.0 * with_arm + tip / 3.0); // ‖x‖² = 1/3
    }
}

std::int64_t SineErrors::doubles_allocated() const {
    std::int64_t doubles = temperature_weights_.size() + slope_weights_.size() +
                           curvature_weights_.size() + deflection_weights_.size() +
                           static_cast<std::int64_t>(moments_.size()) * Pack::size;
    for (const PackSums& packs : packs_)
        doubles += static_cast<std::int64_t>(packs.size()) * Pack::size;
    const auto of_table = [](const SineTable& table) {
        return table.factors.size() + table.table.size();
    };
    if (slope_)
        doubles += of_table(*slope_);
    if (deflection_)
        doubles +=
            of_table(deflection_->slope) + of_table(deflection_->value) + deflection_->arm.size();
    return doubles;
}

} // namespace tvbeam
