#pragma once

#include "core/problem.hpp"
#include "core/sine/basis.hpp"
#include "core/sine/profiles.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace tvbeam {

/// One squared norm of a sum of modes z_k ω_k, orthogonal to each other, and of functions y_j:
///
///     ‖Σ_k z_k ω_k + Σ_j w_j y_j‖² = Σ_k η_k (z_k + Σ_j w_j T_jk)² + wᵀ remainder w
///
/// η_k = ‖ω_k‖², T_jk = (y_j, ω_k)/η_k, remainder_ij = (r_i, r_j), r_j = y_j − Σ_k T_jk ω_k.
struct SineTable {
    ModeArrays factors; ///< η_k
    ModeArrays table;   ///< T_j
    std::vector<std::int64_t> active;
    Eigen::MatrixXd remainder;
};

/// ‖Θ̃_x − θ̃_x‖²: ω_k = φ̂_k', and y_j the profiles of θ̃_x, each less its mean.
struct SlopeOfTemperature : SineTable {
    std::vector<Eigen::Index> profiles; ///< r of y_j
    Eigen::VectorXd means;

    SlopeOfTemperature(const ProblemData& data, const Mesh& mesh, const SineBasis& basis);
};

/// ‖U_x − u_x‖² and ‖U − u‖². The error of the curvature is
///
///     w − u_xx = Σ_k a_k φ̂_k + Σ_j v_j g_j − Σ_j c_j (g_j − Πg_j)
///
/// with the weights c of w, and v those of w less those of u_xx. It is integrated once and twice,
/// with ε = U(1) − u(1) = Σ_k a_k T_0k + Σ_j v_j (g_j, 1 − x):
///
///     U_x − u_x = ε + Σ_k a_k H_k' + …,     U − u = ε x + Σ_k a_k H_k + …
///
/// H_k'' = φ̂_k, zero at both ends. On a uniform mesh the H_k are orthogonal to each other, and the
/// H_k' to each other and to 1, because a step along the mesh multiplies each by exp(ikπh). The y_j
/// are the same integrals of the g_j, then of the g_j − Πg_j that are not zero, whose weights are
/// −c_j.
struct DeflectionTables {
    SineTable slope;
    SineTable value;
    Eigen::Index outside = 0;    ///< how many g_j − Πg_j there are: of the last columns g_j
    Eigen::VectorXd tip_moments; ///< (g_j, 1 − x)
    ModeArrays arm;              ///< (x, H_k)
    Eigen::VectorXd arm_rest;    ///< (x, r_j) of `value`

    /// Without coupling a is zero: the sums over the modes are then put into the remainders and
    /// arm_rest.
    DeflectionTables(const SineProfiles& profiles, const Mesh& mesh, const SineBasis& basis,
                     bool coupled);
};

} // namespace tvbeam
