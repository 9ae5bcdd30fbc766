#include "core/sine/errors.hpp"

#include <utility>

namespace tvbeam {

Eigen::MatrixXd by_profile(const Field& field, Eigen::Index amplitudes, Eigen::Index rows) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(amplitudes, rows);
    for (const auto& term : field.terms)
        matrix(term.amplitude, term.profile) += 1.0;
    return matrix;
}

SineErrors::SineErrors(const Beam& beam, const ProblemData& data, const SineProfiles& profiles,
                       const std::vector<Norm>& norms, bool coupled, Eigen::Index most_steps)
    : sums_(norms), profiles_(profiles), stress_(data.exact ? data.exact->stress : std::nullopt),
      theta_A_(beam.theta_A) {
    const Eigen::Index rows = profiles.expansion.cols();
    const Eigen::MatrixXd columns = profiles.expansion.transpose();
    if (of_temperature()) {
        exact_temperature_ = -by_profile(data.exact->theta, data.amplitude_count, rows) * columns;
        temperature_at_ends_ =
            theta_A_ != 0.0 || (exact_temperature_.leftCols(profiles.linear).array() != 0.0).any();
        temperature_weights_ = TimeSeries::Zero(most_steps, profiles.columns());
    }
    if (of_curvature()) {
        exact_curvature_ = -by_profile(data.exact->u_xx, data.amplitude_count, rows) * columns;
        weight_columns_ = columns;
        curvature_weights_ = TimeSeries::Zero(most_steps, profiles.columns());
        curvature_form_ = profiles.remainder - profiles.projection;
        // Without coupling a is zero, and the sum over the modes a form in v too.
        if (!coupled)
            curvature_form_ += profiles.modes_gram;
        if (!profiles.projection.isZero(0.0))
            outside_form_ = exact_curvature_ * profiles.projection * exact_curvature_.transpose();
    }
}

void SineErrors::weigh(Eigen::Index steps, const TimeSeries& amplitudes,
                       const TimeSeries& weights) {
    if (of_temperature()) {
        temperature_weights_.setZero();
        temperature_weights_.col(0).setConstant(theta_A_);
        add_product(temperature_weights_, amplitudes, exact_temperature_, steps);
    }
    if (of_curvature()) {
        curvature_weights_.setZero();
        add_product(curvature_weights_, weights, weight_columns_, steps);
        add_product(curvature_weights_, amplitudes, exact_curvature_, steps);
    }
}

void SineErrors::add(Eigen::Index steps, double dt, Eigen::VectorXd temperature_squares,
                     Eigen::VectorXd curvature_squares, const TimeSeries& amplitudes,
                     const Eigen::VectorXd& stress) {
    if (of_temperature())
        add_forms(temperature_squares, temperature_weights_, profiles_.remainder, steps);
    if (of_curvature()) {
        add_forms(curvature_squares, curvature_weights_, curvature_form_, steps);
        if (outside_form_.size() > 0)
            add_forms(curvature_squares, amplitudes, outside_form_, steps);
    }
    // A square that round-off made negative is zero; NaN stays NaN.
    const auto non_negative = [](double square) { return square < 0.0 ? 0.0 : square; };
    for (Eigen::Index n = 0; n < steps; ++n) {
        Squares squares = unmeasured();
        if (of_temperature())
            squares[index(Quantity::theta)] = non_negative(temperature_squares(n));
        if (of_curvature())
            squares[index(Quantity::u_xx)] = non_negative(curvature_squares(n));
        const double error = stress(n) - (stress_ ? amplitudes(n, *stress_) : 0.0);
        squares[index(Quantity::stress)] = error * error;
        sums_.add(dt, squares);
    }
}

} // namespace tvbeam
