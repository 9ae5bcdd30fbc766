#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// A step of a time scheme for y_t = F(t, y) as the literature states it. Stated a second time, in
/// other terms than those that run (TimeScheme), so that a wrong row there is noticed.
///
/// A diagonally implicit Runge–Kutta step by its Butcher matrix,
///
///     Y_i = y^{n−1} + Δt Σ_{j ≤ i} a_ij F(t_{n−1} + c_i Δt, Y_j),   c_i = Σ_j a_ij,   y^n =
///     Y_last;
///
/// or the two-step formula (3y^n − 4y^{n−1} + y^{n−2})/(2Δt) = F(t_n, y^n).
struct StatedStep {
    Eigen::MatrixXd a; ///< lower triangular, its last row is b; two steps: 1 × 1, not read
    bool two_step = false;

    [[nodiscard]] Eigen::Index solves() const { return a.rows(); }
    /// Where solve i takes the sources, in steps from t_{n−1}.
    [[nodiscard]] double fraction(Eigen::Index i) const;
    /// Δt times the factor of Y_i in the rate F(Y_i).
    [[nodiscard]] double leading(Eigen::Index i) const;

    /// m_ij = b_i a_ij + b_j a_ji − b_i b_j; positive semidefinite with b ≥ 0: algebraically
    /// stable (Burrage and Butcher 1979). Of a Runge–Kutta step.
    [[nodiscard]] Eigen::MatrixXd algebraic_stability() const;
};

/// Step n = 1, 2, … of
/// - "euler", a = 1;
/// - "sdirk2", a = [γ, 0; 1 − γ, γ] with γ = 1 − 1/√2 (Alexander 1977);
/// - "bdf2", whose first step is one of sdirk2: of order 2 from the start.
/// Throws std::domain_error for another name.
StatedStep stated_step(const std::string& scheme, std::int64_t n);

/// The names that it knows.
std::vector<std::string> stated_schemes();

/// The order in Δt that its authors claim.
int stated_order(const std::string& scheme);

} // namespace tvbeam
