#pragma once

#include "core/norms/norm_sums.hpp"
#include "core/problem.hpp"
#include "core/sine/deflection_tables.hpp"
#include "core/sine/pack_sums.hpp"
#include "core/sine/profiles.hpp"
#include "core/time/time_series.hpp"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>
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
/// where u_xx = Σ_j τ_j g_j; those of Θ̃_x, U_x and U are in deflection_tables.hpp. u and u_x are
/// read as the integrals of u_xx. The sums over the modes are the kernel's; they read v.
class SineErrors {
public:
    /// The quantities that it can measure.
    static constexpr std::array measured{Quantity::theta, Quantity::theta_x, Quantity::u,
                                         Quantity::u_x,   Quantity::u_xx,    Quantity::stress};

    /// Those of them that are not measured on meshes with cells.
    static constexpr std::array on_whole_elements{Quantity::theta_x, Quantity::u, Quantity::u_x};

    /// data and profiles must outlive the object. coupled: a is not zero.
    SineErrors(const Beam& beam, const ProblemData& data, const Mesh& mesh, const SineBasis& basis,
               const SineProfiles& profiles, const std::vector<Norm>& norms, bool coupled,
               Eigen::Index most_steps);

    /// Whether it reads Σ_k a_k T_0k.
    [[nodiscard]] bool of_deflection() const { return deflection_.has_value(); }

    /// The weights of both errors after every step, from the amplitudes and the weights c_r, c_arm
    /// then.
    void weigh(Eigen::Index steps, const TimeSeries& amplitudes, const TimeSeries& weights);

    /// What the kernel sums over θ and over a, from zero.
    [[nodiscard]] std::span<const SineSquare> temperature_squares();
    [[nodiscard]] std::span<const SineSquare> curvature_squares();

    /// Adds the steps to the norms: the modes' sums, to which this adds the rest, and the contact
    /// stresses. tips: Σ_k a_k T_0k.
    void add(Eigen::Index steps, double dt, const TimeSeries& amplitudes,
             const Eigen::VectorXd& tips, const Eigen::VectorXd& stress);

    [[nodiscard]] const NormSums& sums() const { return sums_; }
    [[nodiscard]] std::int64_t doubles_allocated() const;

private:
    [[nodiscard]] bool needs(Quantity quantity) const { return sums_.needed()[index(quantity)]; }
    void prepare_temperature(const ProblemData& data, const Mesh& mesh, const SineBasis& basis);
    void prepare_curvature(const ProblemData& data, const Mesh& mesh, const SineBasis& basis);
    [[nodiscard]] SineSquare square_of(const SineTable& table, const TimeSeries& weights) const;
    [[nodiscard]] SineSquare square_of(const TimeSeries& weights) const;
    void add_square(std::vector<SineSquare>& squares, Quantity quantity, SineSquare square);
    void add_slopes_of_temperature(Eigen::Index steps);
    void add_deflections(Eigen::Index steps, const Eigen::VectorXd& tips);
    [[nodiscard]] Eigen::VectorXd& of(Quantity quantity) { return totals_[index(quantity)]; }

    NormSums sums_;
    const SineProfiles& profiles_;
    std::optional<Eigen::Index> stress_; // amplitude of the exact one
    double theta_A_;
    bool coupled_;
    Eigen::Index most_steps_;

    std::optional<SlopeOfTemperature> slope_;
    std::optional<DeflectionTables> deflection_;
    Eigen::MatrixXd exact_temperature_; // −θ̃ in the g_j; shape: amplitudes × J
    Eigen::MatrixXd exact_slope_;       // −θ̃_x in its profiles; shape: amplitudes × profiles
    Eigen::MatrixXd exact_curvature_;   // −u_xx in the g_j; shape: amplitudes × J
    Eigen::MatrixXd weight_columns_;    // the weights in the g_j; shape: (R + 1) × J
    bool temperature_at_ends_ = false;  // θ̃ is not zero there, so v_0 and v_1 may not be
    Eigen::MatrixXd curvature_form_;    // of v
    Eigen::MatrixXd outside_form_;      // of the amplitudes; empty: zero
    TimeSeries temperature_weights_;
    TimeSeries slope_weights_;
    TimeSeries curvature_weights_;  // v
    TimeSeries deflection_weights_; // v, then −c of what is outside

    std::array<PackSums, quantity_count> packs_; // of the modes; empty: not summed
    PackSums moments_;                           // of the modes with (x, H_k)
    std::array<Eigen::VectorXd, quantity_count> totals_;
    std::vector<SineSquare> temperature_squares_;
    std::vector<SineSquare> curvature_squares_;
};

} // namespace tvbeam
