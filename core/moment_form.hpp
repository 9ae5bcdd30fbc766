#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/solver.hpp"
#include "core/space/profile.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// The curvature w = U_xx of the moment form, as the sum of parts that it keeps apart:
///
///     w = a + Σ_r c_r Πφ_r + c_arm (1 − x) + p
///
/// a is continuous and piecewise linear with a(0) = a(1) = 0, Π the L² projection on P1disc, p in
/// P1disc.
struct SplitCurvature {
    using Vector = Eigen::Map<Eigen::VectorXd>;
    Vector nodal{nullptr, 0};   ///< a at the nodes; shape: s + 1, or empty: zero (alpha = 0)
    Vector weights{nullptr, 0}; ///< c_r for every profile of ProblemData, then c_arm; shape: R + 1
    Eigen::Map<DiscontinuousLinear> rest{
        nullptr, 2, 0}; ///< p; shape: 2 × s, or empty: zero (every moment load separates)
};

/// (24)–(25) written for the curvature w = U_xx, which turns the matrix B of the cubics into an L²
/// mass matrix:
///
///     w + ζ w_t + α Θ̃ + Πμ − λ (1 − x) = 0 in P1disc,     μ = Ĝ + q̂ − m
///     M Θ_t + K Θ − α (w_t, χ) = (f, χ),                   u(1,t) = ∫ (1 − x) w dx
///
/// With the time derivative c (y − y*) and κ = 1/(1 + ζc), w is eliminated, and the increment D = Θ
/// − Θ* solves one symmetric positive definite tridiagonal system, constant in time:
///
///     (cM + K + α²cκ M_c) D = F − KΘ* + αcκ (−w* − αΘ̃* − μ + λ(1 − x), χ)
///
/// The step is made with λ = 0; where the tip passes a stop, λ times the response to λ = 1 is
/// added. This solves the variational inequality of the coupled step exactly.
class MomentForm final : public Solver {
public:
    /// data and mesh must outlive the solver. Throws std::domain_error when the matrix of the first
    /// solve is not positive definite in floating point; that of a later one ends the step with
    /// that reason.
    MomentForm(const Beam& beam, const ProblemData& data, const Mesh& mesh, const Scheme& scheme,
               double dt, const Needs& needs);
    MomentForm(const Beam& beam, const ProblemData& data, Mesh&& mesh, const Scheme& scheme,
               double dt, const Needs& needs) = delete;

    [[nodiscard]] Eigen::Ref<const Eigen::VectorXd> temperature() const override { return theta_; }
    [[nodiscard]] DiscontinuousLinear curvature() const override;
    [[nodiscard]] double tip_displacement() const override;

    /// The curvature without assembling it: error norms use the parts.
    [[nodiscard]] const SplitCurvature& split_curvature() const { return w_; }

private:
    std::string solve(double c, double t,
                      const Eigen::Ref<const Eigen::VectorXd>& amplitudes) override;

    void lay_out_state();
    void load_initial_state();
    void load_profiles();
    [[nodiscard]] bool
    is_bending(Eigen::Index profile) const; // its weight in w is not zero for ever
    void eliminate(double c);
    void find_contact_response();
    void solve_heat(double t, const Eigen::Ref<const Eigen::VectorXd>& amplitudes,
                    const DiscontinuousLinear& rest_increment);
    void make_contact();

    Beam beam_;
    const ProblemData& data_;
    const Mesh& mesh_;
    bool heat_;    // the temperature is solved for
    bool bending_; // the curvature is solved for
    bool coupled_; // alpha ≠ 0: each acts on the other
    bool stops_;   // the tip is tested against the stops
    ThermalMass mass_;

    double leading_ = 0.0; // c, of which the matrix of the step is now
    double kappa_ = 0.0;   // κ
    TridiagonalFactor factor_;
    Eigen::ArrayXd inverse_lengths_;
    std::vector<Eigen::Index> columns_; // profiles with a hat load, in the order of loads_
    Eigen::MatrixXd loads_;             // (φ_r, χ_i) at inner nodes
    Eigen::VectorXd tip_moments_;       // (φ_r, 1 − x) of every profile and of the moment arm
    Eigen::VectorXd arm_load_;          // (1 − x, χ_i), all nodes
    Eigen::VectorXd response_;          // Θ that answers λ = 1
    double compliance_ = 0.0;           // u(1) that answers λ = 1

    SplitCurvature::Vector theta_{nullptr, 0}; // these two are parts of state_
    SplitCurvature w_;

    Eigen::VectorXd increment_;      // D at inner nodes
    Eigen::VectorXd balance_;        // a + αΘ
    Eigen::VectorXd weight_changes_; // −κ (c_r + μ_r)
    Eigen::VectorXd load_weights_;   // what each profile adds to the heat equation
    Eigen::VectorXd column_weights_; // those of the columns of loads_
    std::vector<DiscontinuousLinear>
        projections_; // Πφ_r of those that bend, where the curvature is read in every step
};

} // namespace tvbeam
