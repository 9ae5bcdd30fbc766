#include "core/space/point_values.hpp"

#include "core/space/cells.hpp"
#include "core/space/quadrature.hpp"

#include <cmath>

namespace tvbeam {

namespace {

using Eigen::Index;

/// Row i: the weights of ∫_0^{ξ_i}. Through the Legendre polynomials of 2ξ − 1, whose coefficients
/// the rule gives, because ∫_0^ξ P_k = (P_{k+1} − P_{k−1}) / (2 (2k + 1)), P_{−1} = −1.
Eigen::MatrixXd integration_matrix() {
    const GaussRule& rule = element_rule();
    const auto legendre = [&](int k, Index i) {
        return k < 0 ? -1.0 : std::legendre(static_cast<unsigned>(k), 2.0 * rule.points(i) - 1.0);
    };
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(element_rule_size, element_rule_size);
    for (Index i = 0; i < element_rule_size; ++i)
        for (Index q = 0; q < element_rule_size; ++q)
            for (int k = 0; k < element_rule_size; ++k)
                matrix(i, q) += rule.weights(q) * legendre(k, q) *
                                (legendre(k + 1, i) - legendre(k - 1, i)) / 2.0;
    return matrix;
}

/// ∫_0^x g at the points; the last argument receives it at 1.
PointValues integral(const Mesh& cells, const PointValues& g, double& total) {
    static const Eigen::MatrixXd matrix = integration_matrix();
    PointValues result = (matrix * g.matrix()).array().rowwise() * cells.lengths.transpose();
    const Eigen::ArrayXd each =
        (g.matrix().transpose() * element_rule().weights.matrix()).array() * cells.lengths;
    total = 0.0;
    for (Index cell = 0; cell < cells.elements(); ++cell) {
        result.col(cell) += total;
        total += each(cell);
    }
    return result;
}

PointValues points_of(const Mesh& mesh) {
    return element_points(mesh, 0, mesh.elements());
}

/// ∫ g (1 − ξ) dx, ∫ g ξ dx of every element; shape: 2 × s.
Eigen::Array2Xd end_moments(const Mesh& mesh, const PointValues& g) {
    const GaussRule& rule = element_rule();
    Eigen::Matrix<double, 2, element_rule_size> test;
    test.row(0) = (rule.weights * (1.0 - rule.points)).matrix().transpose();
    test.row(1) = (rule.weights * rule.points).matrix().transpose();
    return of_elements(mesh, 0, mesh.elements(),
                       (test * g.matrix()).array().rowwise() *
                           integration_mesh(mesh).lengths.transpose());
}

/// Linear on every element, from the values at its ends.
PointValues between(const Mesh& mesh, const Eigen::Array2Xd& ends) {
    const Eigen::VectorXd right = element_rule().points.matrix();
    const Eigen::VectorXd left = (1.0 - right.array()).matrix();
    const Eigen::Array2Xd at_ends = at_cell_ends(mesh, 0, ends);
    return (left * at_ends.row(0).matrix() + right * at_ends.row(1).matrix()).array();
}

} // namespace

Antiderivatives antiderivatives(const Mesh& mesh, const PointValues& g) {
    const Mesh& cells = integration_mesh(mesh);
    Antiderivatives result;
    double total = 0.0;
    result.first = integral(cells, g, total);
    result.second = integral(cells, result.first, result.tip);
    result.first -= result.tip;
    result.second -= result.tip * points_of(mesh);
    return result;
}

Eigen::VectorXd hat_loads(const Mesh& mesh, const PointValues& g) {
    const Eigen::Array2Xd moments = end_moments(mesh, g);
    const Index s = mesh.elements();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(s + 1);
    loads.head(s) += moments.row(0).matrix().transpose();
    loads.tail(s) += moments.row(1).matrix().transpose();
    return loads;
}

PointValues piecewise_linear(const Mesh& mesh, const Eigen::VectorXd& nodal) {
    const Index s = mesh.elements();
    Eigen::Array2Xd ends(2, s);
    ends << nodal.head(s).transpose().array(), nodal.tail(s).transpose().array();
    return between(mesh, ends);
}

DiscontinuousLinear project(const Mesh& mesh, const PointValues& g) {
    // The element mass matrix h/6 [2 1; 1 2] has the inverse 2/h [2 −1; −1 2].
    const Eigen::Array2Xd moments = end_moments(mesh, g);
    DiscontinuousLinear ends(2, mesh.elements());
    ends.row(0) = 2.0 * (2.0 * moments.row(0) - moments.row(1)) / mesh.lengths.transpose();
    ends.row(1) = 2.0 * (2.0 * moments.row(1) - moments.row(0)) / mesh.lengths.transpose();
    return ends;
}

PointValues without_projection(const Mesh& mesh, const PointValues& g) {
    return g - between(mesh, project(mesh, g));
}

PointValues point_weights(const Mesh& mesh) {
    return (element_rule().weights.matrix() * integration_mesh(mesh).lengths.matrix().transpose())
        .array();
}

} // namespace tvbeam
