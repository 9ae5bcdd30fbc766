#include "studies/reference/piecewise_polynomial.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tvbeam {

using Eigen::Index;

namespace {

/// Values at ξ = −offset, 1 − offset, 2 − offset, 3 − offset to coefficients of the cubic in ξ.
Eigen::Matrix4d cubic_through_four(Index offset) {
    Eigen::Matrix4d powers;
    for (Index i = 0; i < 4; ++i)
        for (Index k = 0; k < 4; ++k)
            powers(i, k) = std::pow(static_cast<double>(i - offset), static_cast<double>(k));
    return powers.inverse();
}

} // namespace

PiecewisePolynomial PiecewisePolynomial::linear(const DiscontinuousLinear& ends) {
    Eigen::MatrixXd coefficients(2, ends.cols());
    coefficients.row(0) = ends.row(0).matrix();
    coefficients.row(1) = (ends.row(1) - ends.row(0)).matrix();
    return PiecewisePolynomial(std::move(coefficients));
}

PiecewisePolynomial PiecewisePolynomial::linear(const Eigen::VectorXd& nodal) {
    const Index s = nodal.size() - 1;
    DiscontinuousLinear ends(2, s);
    ends.row(0) = nodal.head(s).transpose().array();
    ends.row(1) = nodal.tail(s).transpose().array();
    return linear(ends);
}

PiecewisePolynomial PiecewisePolynomial::cubic(const Eigen::VectorXd& nodal) {
    static const std::array<Eigen::Matrix4d, 3> fits{cubic_through_four(0), cubic_through_four(1),
                                                     cubic_through_four(2)};
    const Index s = nodal.size() - 1;
    if (s < 3)
        throw std::invalid_argument("a cubic needs four nodes");
    Eigen::MatrixXd coefficients(4, s);
    for (Index j = 0; j < s; ++j) {
        const Index first = std::clamp<Index>(j - 1, 0, s - 3);
        coefficients.col(j) = fits[static_cast<std::size_t>(j - first)] * nodal.segment<4>(first);
    }
    return PiecewisePolynomial(std::move(coefficients));
}

PiecewisePolynomial PiecewisePolynomial::derivative() const {
    const Index degree = coefficients_.rows() - 1;
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(std::max<Index>(degree, 1), coefficients_.cols());
    for (Index k = 0; k < degree; ++k)
        result.row(k) = static_cast<double>(k + 1) * elements() * coefficients_.row(k + 1);
    return PiecewisePolynomial(std::move(result));
}

PiecewisePolynomial PiecewisePolynomial::integral() const {
    Eigen::MatrixXd result(coefficients_.rows() + 1, coefficients_.cols());
    for (Index k = 0; k < coefficients_.rows(); ++k)
        result.row(k + 1) = coefficients_.row(k) / (static_cast<double>(k + 1) * elements());
    result(0, 0) = 0.0;
    for (Index j = 1; j < result.cols(); ++j)
        result(0, j) = result.col(j - 1).sum();
    return PiecewisePolynomial(std::move(result));
}

Eigen::ArrayXd PiecewisePolynomial::operator()(const Eigen::ArrayXd& x) const {
    Eigen::ArrayXd values(x.size());
    for (Index i = 0; i < x.size(); ++i) {
        const double scaled = x(i) * elements();
        const Index j = std::clamp<Index>(static_cast<Index>(scaled), 0, coefficients_.cols() - 1);
        const double xi = scaled - static_cast<double>(j);
        double value = 0.0;
        for (Index k = coefficients_.rows(); k-- > 0;)
            value = value * xi + coefficients_(k, j);
        values(i) = value;
    }
    return values;
}

} // namespace tvbeam
