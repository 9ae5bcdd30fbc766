#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// A profile φ(x) of a load, seen by the spaces of the moment form.
struct LoadProfile {
    Eigen::VectorXd hat_load; ///< (φ, χ_i), i = 0 … s
    double tip_moment = 0.0; ///< (φ, 1 − x): what a curvature φ adds to the tip displacement u(1)
};

LoadProfile load_profile(const Mesh& mesh, const SpaceFunction& phi);

/// Profiles φ_r seen by an error norm. With I_h the nodal interpolation and Π the L² projection on
/// P1disc, the error of a discrete function with nodal part e and weights γ_r, τ_r splits into
/// parts that are each as small as the error itself:
///
///     ‖e + Σ γ_r (Πφ_r − I_hφ_r) − Σ τ_r (φ_r − Πφ_r)‖²
///         = eᵀM_c e + 2 Σ γ_r e·d_r + γᵀ(Q − P)γ + τᵀPτ
struct ErrorProfiles {
    Eigen::MatrixXd nodal;         ///< φ_r(x_i); shape: (s + 1) × R
    Eigen::MatrixXd defect_load;   ///< d_r: (φ_r − I_hφ_r, χ_i); shape: (s + 1) × R
    Eigen::MatrixXd interpolation; ///< Q_rs = (φ_r − I_hφ_r, φ_s − I_hφ_s); shape: R × R
    Eigen::MatrixXd projection;    ///< P_rs = (φ_r − Πφ_r, φ_s − Πφ_s); shape: R × R
};

ErrorProfiles error_profiles(const Mesh& mesh, const std::vector<SpaceFunction>& profiles);

} // namespace tvbeam
