#include "core/space/linear_elements.hpp"

#include "core/space/cells.hpp"
#include "core/space/quadrature.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

namespace {

/// The two moments ∫ g (1 − ξ) dx, ∫ g ξ dx of every element; shape: 2 × s.
Eigen::Array2Xd end_moments(const Mesh& mesh, const SpaceFunction& g) {
    const GaussRule& rule = element_rule();
    Eigen::Matrix<double, 2, element_rule_size> test;
    test.row(0) = (rule.weights * (1.0 - rule.points)).matrix().transpose();
    test.row(1) = (rule.weights * rule.points).matrix().transpose();
    Eigen::Array2Xd moments(2, mesh.elements());
    for_each_block(mesh, [&](Eigen::Index first, Eigen::Index count) {
        const Eigen::ArrayXd values = g(element_points(mesh, first, count).reshaped());
        const CellRange cells = cells_of(mesh, first, count);
        const Eigen::Map<const Eigen::Matrix<double, element_rule_size, Eigen::Dynamic>> columns(
            values.data(), element_rule_size, cells.count);
        // A general product would be dearer than the values themselves.
        moments.middleCols(first, count) = of_elements(
            mesh, first, count,
            test.lazyProduct(columns).array().rowwise() *
                integration_mesh(mesh).lengths.segment(cells.first, cells.count).transpose());
    });
    return moments;
}

Eigen::VectorXd gather(const Eigen::Array2Xd& moments) {
    const Eigen::Index s = moments.cols();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(s + 1);
    loads.head(s) += moments.row(0).matrix().transpose();
    loads.tail(s) += moments.row(1).matrix().transpose();
    return loads;
}

} // namespace

Tridiagonal thermal_mass_matrix(const Mesh& mesh, ThermalMass kind) {
    const Eigen::Index inner = mesh.elements() - 1;
    const auto& h = mesh.lengths;
    const auto support = (h.head(inner) + h.tail(inner)).matrix();
    if (kind == ThermalMass::lumped)
        return {support / 2.0, Eigen::VectorXd::Zero(std::max<Eigen::Index>(inner - 1, 0)),
                support / 2.0};
    Tridiagonal mass{support / 3.0,
                     inner > 1 ? Eigen::VectorXd(h.segment(1, inner - 1) / 6.0)
                               : Eigen::VectorXd(0),
                     support / 3.0};
    mass.row_sums.head(mass.coupling.size()) += mass.coupling;
    mass.row_sums.tail(mass.coupling.size()) += mass.coupling;
    return mass;
}

Tridiagonal stiffness_matrix(const Mesh& mesh) {
    const Eigen::Index inner = mesh.elements() - 1;
    const auto slope = mesh.lengths.inverse();
    Eigen::VectorXd row_sums = Eigen::VectorXd::Zero(inner); // (Σ_j χ_j)' is zero but at the ends
    if (inner > 0) {
        row_sums(0) += slope(0);
        row_sums(inner - 1) += slope(inner);
    }
    return {slope.head(inner) + slope.tail(inner),
            inner > 1 ? Eigen::VectorXd(-slope.segment(1, inner - 1)) : Eigen::VectorXd(0),
            std::move(row_sums)};
}

Eigen::VectorXd hat_loads(const Mesh& mesh, const SpaceFunction& g) {
    return gather(end_moments(mesh, g));
}

Eigen::VectorXd hat_loads(const Mesh& mesh, const DiscontinuousLinear& p) {
    const Eigen::Index s = mesh.elements();
    const auto left = p.row(0).transpose();
    const auto right = p.row(1).transpose();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(s + 1);
    loads.head(s).array() += mesh.lengths * (2.0 * left + right) / 6.0;
    loads.tail(s).array() += mesh.lengths * (left + 2.0 * right) / 6.0;
    return loads;
}

double tip_moment(const Mesh& mesh, const DiscontinuousLinear& p) {
    const Eigen::Index s = mesh.elements();
    const Eigen::ArrayXd arm = 1.0 - mesh.nodes;
    const auto left = p.row(0).transpose();
    const auto right = p.row(1).transpose();
    return (mesh.lengths *
            (arm.head(s) * (2.0 * left + right) + arm.tail(s) * (left + 2.0 * right)))
               .sum() /
           6.0;
}

double inner_product(const Mesh& mesh, const DiscontinuousLinear& p, const DiscontinuousLinear& q) {
    return (mesh.lengths.transpose() *
            (p.row(0) * (2.0 * q.row(0) + q.row(1)) + p.row(1) * (q.row(0) + 2.0 * q.row(1))))
               .sum() /
           6.0;
}

DiscontinuousLinear project(const Mesh& mesh, const SpaceFunction& g) {
    // The element mass matrix h/6 [2 1; 1 2] has the inverse 2/h [2 −1; −1 2].
    DiscontinuousLinear p = end_moments(mesh, g);
    for (Eigen::Index j = 0; j < p.cols(); ++j) {
        const double left = p(0, j);
        const double right = p(1, j);
        p(0, j) = 2.0 * (2.0 * left - right) / mesh.lengths(j);
        p(1, j) = 2.0 * (2.0 * right - left) / mesh.lengths(j);
    }
    return p;
}

double squared_norm(const Mesh& mesh, const Eigen::VectorXd& v) {
    const Eigen::Index s = mesh.elements();
    const auto left = v.head(s).array();
    const auto right = v.tail(s).array();
    return (mesh.lengths * (left * (left + right) + right * right)).sum() / 3.0;
}

} // namespace tvbeam
