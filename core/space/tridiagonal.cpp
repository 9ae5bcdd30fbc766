#include "core/space/tridiagonal.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace tvbeam {

Tridiagonal operator+(Tridiagonal a, const Tridiagonal& b) {
    a.diagonal += b.diagonal;
    a.coupling += b.coupling;
    a.row_sums += b.row_sums;
    return a;
}

Tridiagonal operator*(Tridiagonal a, double factor) {
    a.diagonal *= factor;
    a.coupling *= factor;
    a.row_sums *= factor;
    return a;
}

Eigen::VectorXd Tridiagonal::operator*(const Eigen::VectorXd& x) const {
    Eigen::VectorXd y = diagonal.cwiseProduct(x);
    const Eigen::Index n = coupling.size();
    if (n > 0) {
        y.head(n) += coupling.cwiseProduct(x.tail(n));
        y.tail(n) += coupling.cwiseProduct(x.head(n));
    }
    return y;
}

TridiagonalFactor::TridiagonalFactor(const Tridiagonal& matrix)
    : multipliers_(matrix.diagonal.size()), inverse_pivots_(matrix.diagonal.size()) {
    double pivot = 0.0;
    double sum = 0.0; // of the row, of what elimination has left of the matrix
    for (Eigen::Index i = 0; i < order(); ++i) {
        multipliers_(i) = i == 0 ? 0.0 : matrix.coupling(i - 1) / pivot;
        sum = matrix.row_sums(i) - multipliers_(i) * sum;
        pivot = i + 1 < order() ? sum - matrix.coupling(i) : sum;
        if (!std::isfinite(pivot) || !std::isfinite(1.0 / pivot))
            throw std::domain_error(
                "the matrix of the step is beyond the range of floating point: pivot " +
                std::to_string(i) + " or its inverse is not finite");
        if (!(pivot > 0.0))
            throw std::domain_error("the matrix of the step is not positive definite: pivot " +
                                    std::to_string(i) + " is " + std::to_string(pivot));
        inverse_pivots_(i) = 1.0 / pivot;
    }
}

void TridiagonalFactor::solve_in_place(Eigen::Ref<Eigen::VectorXd> x) const {
    const Eigen::Index n = order();
    for (Eigen::Index i = 1; i < n; ++i)
        x(i) -= multipliers_(i) * x(i - 1);
    if (n > 0)
        x(n - 1) *= inverse_pivots_(n - 1);
    for (Eigen::Index i = n - 2; i >= 0; --i)
        x(i) = x(i) * inverse_pivots_(i) - multipliers_(i + 1) * x(i + 1);
}

} // namespace tvbeam
