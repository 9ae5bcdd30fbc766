#pragma once

#include "core/space/linear_elements.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// A function on [0, 1] that is a polynomial on each of s equal elements; it may jump between them.
class PiecewisePolynomial {
public:
    /// Linear on each element, from its values at the two ends.
    static PiecewisePolynomial linear(const DiscontinuousLinear& ends);

    /// Linear and continuous, from its values at the s + 1 nodes.
    static PiecewisePolynomial linear(const Eigen::VectorXd& nodal);

    /// On each element the cubic through the four nearest nodes, continuous: fourth order for
    /// smooth functions. At least three elements.
    static PiecewisePolynomial cubic(const Eigen::VectorXd& nodal);

    [[nodiscard]] PiecewisePolynomial derivative() const;

    /// ∫_0^x: continuous, and zero at x = 0.
    [[nodiscard]] PiecewisePolynomial integral() const;

    /// At points of [0, 1]; at a node where it jumps, the value of the element to the right.
    [[nodiscard]] Eigen::ArrayXd operator()(const Eigen::ArrayXd& x) const;

private:
    explicit PiecewisePolynomial(Eigen::MatrixXd coefficients)
        : coefficients_(std::move(coefficients)) {}

    [[nodiscard]] double elements() const { return static_cast<double>(coefficients_.cols()); }

    Eigen::MatrixXd coefficients_; // of ξ^k, ξ = s x − j; shape: (degree + 1) × s
};

} // namespace tvbeam
