#include "core/low_rank/chebyshev.hpp"

#include "core/dense_kernels.hpp"

#include <cmath>
#include <numbers>

namespace tvbeam {

namespace {

/// cos(k (2j + 1) π/2n), the argument reduced to one period first.
double cosine(Eigen::Index k, Eigen::Index j, Eigen::Index n) {
    const Eigen::Index reduced = k * (2 * j + 1) % (4 * n);
    return std::cos(static_cast<double>(reduced) * std::numbers::pi / static_cast<double>(2 * n));
}

} // namespace

Eigen::ArrayXd chebyshev_points(Eigen::Index n) {
    Eigen::ArrayXd points(n);
    for (Eigen::Index j = 0; j < n; ++j)
        points(j) = cosine(1, j, n);
    return points;
}

Eigen::MatrixXd chebyshev_transform(Eigen::Index n) {
    Eigen::MatrixXd transform(n, n);
    for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index j = 0; j < n; ++j)
            transform(k, j) = (k == 0 ? 1.0 : 2.0) / static_cast<double>(n) * cosine(k, j, n);
    return transform;
}

Eigen::MatrixXd chebyshev_values(Eigen::Index n, const Eigen::ArrayXd& y) {
    // A column for each k: the recurrence runs over whole arrays.
    Eigen::MatrixXd values(y.size(), n);
    for (Eigen::Index k = 0; k < n; ++k) {
        if (k == 0)
            values.col(k).setOnes();
        else if (k == 1)
            values.col(k) = y.matrix();
        else
            values.col(k) =
                (2.0 * y * values.col(k - 1).array() - values.col(k - 2).array()).matrix();
    }
    return values.transpose();
}

Eigen::ArrayXd chebyshev_sum(const Eigen::VectorXd& coefficients, const Eigen::ArrayXd& y) {
    Eigen::ArrayXd sum(y.size());
    chosen_dense_kernel().chebyshev_sum(
        {sum.data(), y.data(), y.size(), coefficients.data(), coefficients.size()});
    return sum;
}

} // namespace tvbeam
