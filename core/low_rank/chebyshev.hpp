#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// The zeros of T_n, cos((2j + 1)π/2n), j = 0 … n − 1, in (−1, 1): where a function is sampled.
Eigen::ArrayXd chebyshev_points(Eigen::Index n);

/// The matrix that takes values at chebyshev_points(n) to the coefficients c of the polynomial
/// Σ c_k T_k of degree n − 1 through them; shape: n × n.
Eigen::MatrixXd chebyshev_transform(Eigen::Index n);

/// T_k(y), k = 0 … n − 1; shape: n × y.size(). |y| ≤ 1, but for round-off.
Eigen::MatrixXd chebyshev_values(Eigen::Index n, const Eigen::ArrayXd& y);

/// Σ c_k T_k(y) by Clenshaw's recurrence.
Eigen::ArrayXd chebyshev_sum(const Eigen::VectorXd& coefficients, const Eigen::ArrayXd& y);

} // namespace tvbeam
