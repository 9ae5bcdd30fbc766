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

TridiagonalFactor::TridiagonalFactor(const Tridiagonal& matrix, Elimination elimination)
    : last_(elimination == Elimination::from_both_ends ? matrix.diagonal.size() / 2
                                                       : matrix.diagonal.size() - 1),
      multipliers_(Eigen::VectorXd::Zero(matrix.diagonal.size())),
      inverse_pivots_(matrix.diagonal.size()) {
    const auto invert = [&](Eigen::Index i, double pivot) {
        if (!std::isfinite(pivot) || !std::isfinite(1.0 / pivot))
            throw std::domain_error(
                "the matrix of the step is beyond the range of floating point: pivot " +
                std::to_string(i) + " or its inverse is not finite");
        if (!(pivot > 0.0))
            throw std::domain_error("the matrix of the step is not positive definite: pivot " +
                                    std::to_string(i) + " is " + std::to_string(pivot));
        inverse_pivots_(i) = 1.0 / pivot;
    };
    if (order() == 0)
        return;
    const Eigen::Index m = last_;
    double sum = 0.0; // of the row, of what elimination has left of the matrix
    for (Eigen::Index i = 0; i < m; ++i) {
        sum = matrix.row_sums(i) - multipliers_(i) * sum;
        const double pivot = sum - matrix.coupling(i);
        invert(i, pivot);
        multipliers_(i + 1) = matrix.coupling(i) / pivot;
    }
    double of_last = matrix.row_sums(m) - multipliers_(m) * sum;
    sum = 0.0;
    for (Eigen::Index i = order() - 1; i > m; --i) {
        sum = matrix.row_sums(i) - (i + 1 < order() ? multipliers_(i + 1) * sum : 0.0);
        const double pivot = sum - matrix.coupling(i - 1);
        invert(i, pivot);
        multipliers_(i) = matrix.coupling(i - 1) / pivot;
    }
    of_last -= m + 1 < order() ? multipliers_(m + 1) * sum : 0.0;
    invert(m, of_last);
}

void TridiagonalFactor::solve_in_place(Eigen::Ref<Eigen::VectorXd> x) const {
    const Eigen::Index n = order();
    if (n == 0)
        return;
    const Eigen::Index m = last_;
    const double* const l = multipliers_.data();
    const double* const inverse = inverse_pivots_.data();
    double* const v = x.data();
    double left = v[0];
    double right = v[n - 1];
    Eigen::Index i = 1;
    for (Eigen::Index j = n - 2; j > m; ++i, --j) {
        v[i] = left = v[i] - l[i] * left;
        v[j] = right = v[j] - l[j + 1] * right;
    }
    for (; i < m; ++i)
        v[i] = left = v[i] - l[i] * left;
    double last = v[m];
    if (m > 0)
        last -= l[m] * left;
    if (m + 1 < n)
        last -= l[m + 1] * right;
    v[m] = left = right = last * inverse[m];
    i = m - 1;
    for (Eigen::Index j = m + 1; j < n; --i, ++j) {
        v[i] = left = v[i] * inverse[i] - l[i + 1] * left;
        v[j] = right = v[j] * inverse[j] - l[j] * right;
    }
    for (; i >= 0; --i)
        v[i] = left = v[i] * inverse[i] - l[i + 1] * left;
}

} // namespace tvbeam
