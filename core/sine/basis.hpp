#pragma once

#include <Eigen/Core>

#include <memory>

namespace tvbeam {

/// The basis of S_0^h on a uniform mesh in which M, K and M_c are all diagonal:
///
///     φ̂_k(x_i) = ν_k sin(kπx_i),  k = 1 … s − 1,     (φ̂_k, φ̂_l) = δ_kl
///
/// orthonormal in L², so that ‖v‖² is the sum of the squares of the coefficients of v. Row k − 1 of
/// every array belongs to φ̂_k.
class SineBasis {
public:
    /// Whether the transform of s elements is fast and keeps round-off: s has small prime factors.
    static bool suits(Eigen::Index elements);

    /// s ≥ 1.
    explicit SineBasis(Eigen::Index elements);

    [[nodiscard]] Eigen::Index size() const { return stiffness_.size(); }

    [[nodiscard]] const Eigen::ArrayXd& stiffness() const { return stiffness_; } ///< |φ̂_k'|²
    [[nodiscard]] Eigen::ArrayXd lumped_mass() const; ///< of the row sums of (χ_i, χ_j)

    /// (g, φ̂_k) from (g, χ_i), i = 0 … s.
    [[nodiscard]] Eigen::ArrayXd of_load(const Eigen::VectorXd& hat_load) const;

    /// The coefficients of the function of S_0^h with these nodal values, i = 0 … s.
    [[nodiscard]] Eigen::ArrayXd of_nodal(const Eigen::VectorXd& nodal) const;

    /// The values at the nodes i = 0 … s of the function with these coefficients.
    [[nodiscard]] Eigen::VectorXd nodal(const Eigen::ArrayXd& coefficients) const;

    // Of H_k with H_k'' = φ̂_k, zero at both ends:
    [[nodiscard]] Eigen::ArrayXd slope_squares() const; ///< ‖H_k'‖²
    [[nodiscard]] Eigen::ArrayXd value_squares() const; ///< ‖H_k‖²

    [[nodiscard]] Eigen::ArrayXd left_hat() const;  ///< (1 − x, φ̂_k)
    [[nodiscard]] Eigen::ArrayXd right_hat() const; ///< (x, φ̂_k)

private:
    class Transform;

    Eigen::Index elements_;
    std::shared_ptr<const Transform> transform_;
    Eigen::ArrayXd sines_; // sin(kπ/2s)
    Eigen::ArrayXd mass_;  // m_k: M_c's eigenvalue on the vector sin(kπx_i)
    Eigen::ArrayXd scale_; // ν_k
    Eigen::ArrayXd stiffness_;
};

} // namespace tvbeam
