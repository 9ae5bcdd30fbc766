#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/solver.hpp"
#include "core/space/deflection.hpp"
#include "core/space/tridiagonal.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstdint>
#include <vector>

namespace tvbeam {

/// The algorithm of the paper's Section 3, literally: nodal values c of Θ and values and slopes d
/// of U in the basis of Hermite cubics η_j, and in every step an iteration between the two fields,
///
///     (M + ΔtK) c^l = M c^{n−1} + αC (d^{n−1} − d^{l−1}) + Δt (f, χ)
///     (Δt + ζ) B d^l = ζB d^{n−1} + αΔt Cᵀ c^l + Δt [−(G, η') − (q, η) + m η'(1) + λ η(1)]
///     C_ij = (χ_i', η_j'),  B_ij = (η_i'', η_j''),  U^{n,0} = U^{n−1}
///
/// until no nodal value changes by more than the tolerance (absolute; the paper does not say what
/// it measures). The variational inequality concerns the tip value alone and is solved exactly in
/// each iteration. For the other time schemes Δt stands for 1/c and the state before for y*
/// (Stage). The iteration contracts by about α²Δt / ((Δt + ζ)(1 + π²Δt)), better where a stop
/// holds the tip (contraction.hpp); the round-off of B grows like h⁻⁴ (round_off.hpp). With an end
/// temperature, θ̃_x = θ_x − θ_A adds −αθ_A (1, η') to the loads.
class HermiteForm final : public Solver {
public:
    /// data and mesh must outlive the solver. Throws std::domain_error when a matrix cannot be
    /// factored.
    HermiteForm(const Beam& beam, const ProblemData& data, const Mesh& mesh, const Scheme& scheme,
                double dt);
    HermiteForm(const Beam& beam, const ProblemData& data, Mesh&& mesh, const Scheme& scheme,
                double dt) = delete;

    [[nodiscard]] Eigen::Ref<const Eigen::VectorXd> temperature() const override { return theta_; }
    [[nodiscard]] DiscontinuousLinear curvature() const override;
    [[nodiscard]] double tip_displacement() const override;

    /// The nodal values themselves.
    [[nodiscard]] Deflection nodal_deflection() const;

    /// The largest change of a nodal temperature in each iteration of the last solve.
    [[nodiscard]] const std::vector<double>& temperature_changes() const { return changes_; }

    /// How often the matrices that depend on c were factored: once for each c that comes up anew.
    [[nodiscard]] std::int64_t factorizations() const { return factorizations_; }

    /// An iteration that has not converged by then is given up.
    static constexpr int iteration_limit = 1000;

private:
    std::string solve(double c, double t,
                      const Eigen::Ref<const Eigen::VectorXd>& amplitudes) override;

    void assemble();
    void factor(double c);
    /// Of an iteration that does not converge: its factor, where that is the reason; else nothing.
    [[nodiscard]] std::string predicted() const;
    void project_initial_state();
    [[nodiscard]] Eigen::VectorXd heat_load(double t,
                                            const Eigen::Ref<const Eigen::VectorXd>& amplitudes);
    [[nodiscard]] Eigen::VectorXd beam_load(double t,
                                            const Eigen::Ref<const Eigen::VectorXd>& amplitudes);

    Beam beam_;
    const ProblemData& data_;
    const Mesh& mesh_;
    ThermalMass mass_kind_;
    double tolerance_;
    double leading_ = 0.0; // c, of which the factors are now
    double dt_ = 0.0;      // 1/c
    std::int64_t factorizations_ = 0;

    Tridiagonal mass_;                     // M
    TridiagonalFactor heat_;               // M + ΔtK
    Eigen::SparseMatrix<double> bending_;  // B
    Eigen::SparseMatrix<double> coupling_; // C
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
        bending_factor_;
    Eigen::VectorXd tip_response_; // B⁻¹ η(1), times Δt/(Δt + ζ): d that answers λ = 1

    std::vector<double> changes_;

    struct ProfileLoads {
        Eigen::VectorXd hat;   // (φ, χ_i), inner nodes; empty: not a heat source
        Eigen::VectorXd slope; // (φ, η_j'); empty: not in G
        Eigen::VectorXd value; // (φ, η_j); empty: not in q
    };
    std::vector<ProfileLoads> loads_;

    Eigen::Map<Eigen::VectorXd> theta_{nullptr, 0}; // these two are the parts of state_: c with the
                                                    // two zeros at the ends,
    Eigen::Map<Eigen::VectorXd> deflection_{nullptr, 0}; // d: U_1, U_1', U_2, U_2', …; shape: 2s
};

} // namespace tvbeam
