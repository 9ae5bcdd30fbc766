#pragma once

#include "core/norms/norm_sums.hpp"
#include "core/problem.hpp"
#include "core/sine/profiles.hpp"
#include "core/time/time_series.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tvbeam {

/// The amplitudes' parts in a field; shape: amplitudes × rows, a column a profile. The last column
/// is the moment arm's and zero.
Eigen::MatrixXd by_profile(const Field& field, Eigen::Index amplitudes, Eigen::Index rows);

/// The error norms of a run in the sine basis. With the functions g_j of SineProfiles and the
/// difference v = Σ_j v_j g_j of what is no mode,
///
///     ‖Θ̃ − θ̃‖² = Σ_k (Θ_k + Σ_j v_j T_jk)² + vᵀ remainder v
///     ‖w − u_xx‖² = Σ_k (a_k + Σ_j v_j T_jk)² + vᵀ (remainder − projection) v + τᵀ projection τ
///
/// where u_xx = Σ_j τ_j g_j. The sums over the modes are the kernel's; they read v.
class SineErrors {
public:
    /// The quantities that it can measure; a norm of any other is for the general form.
    static constexpr std::array measured{Quantity::theta, Quantity::u_xx, Quantity::stress};

    /// data and profiles must outlive the object. coupled: a is not zero.
    SineErrors(const Beam& beam, const ProblemData& data, const SineProfiles& profiles,
               const std::vector<Norm>& norms, bool coupled, Eigen::Index most_steps);

    [[nodiscard]] bool of_temperature() const { return needs(Quantity::theta); }
    [[nodiscard]] bool of_curvature() const { return needs(Quantity::u_xx); }

    /// v of both errors after every step, from the amplitudes and the weights c_r, c_arm then.
    void weigh(Eigen::Index steps, const TimeSeries& amplitudes, const TimeSeries& weights);
    [[nodiscard]] const TimeSeries& temperature_weights() const { return temperature_weights_; }
    [[nodiscard]] const TimeSeries& curvature_weights() const { return curvature_weights_; }
    [[nodiscard]] Eigen::Index first_temperature_column() const {
        return temperature_at_ends_ ? 0 : profiles_.linear;
    }

    /// Adds the steps to the norms: the modes' sums, to which this adds the rest, and the contact
    /// stresses.
    void add(Eigen::Index steps, double dt, Eigen::VectorXd temperature_squares,
             Eigen::VectorXd curvature_squares, const TimeSeries& amplitudes,
             const Eigen::VectorXd& stress);

    [[nodiscard]] const NormSums& sums() const { return sums_; }

private:
    [[nodiscard]] bool needs(Quantity quantity) const { return sums_.needed()[index(quantity)]; }

    NormSums sums_;
    const SineProfiles& profiles_;
    std::optional<Eigen::Index> stress_; // amplitude of the exact one
    double theta_A_;

    Eigen::MatrixXd exact_temperature_; // −θ̃ in the g_j; shape: amplitudes × J
    Eigen::MatrixXd exact_curvature_;   // −u_xx in the g_j; shape: amplitudes × J
    Eigen::MatrixXd weight_columns_;    // the weights in the g_j; shape: (R + 1) × J
    bool temperature_at_ends_ = false;  // θ̃ is not zero there, so v_0 and v_1 may not be
    Eigen::MatrixXd curvature_form_;    // of v
    Eigen::MatrixXd outside_form_;      // of the amplitudes; empty: zero
    TimeSeries temperature_weights_;
    TimeSeries curvature_weights_;
};

} // namespace tvbeam
