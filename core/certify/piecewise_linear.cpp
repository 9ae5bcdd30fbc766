#include "core/certify/piecewise_linear.hpp"

#include <gsl/gsl_integration.h>

#include <memory>
#include <new>

namespace tvbeam::certify {

double product(const Mesh& mesh, const BrokenLinear& p, const BrokenLinear& q) {
    // ∫ over an element of length h: h/6 (2 p0 q0 + p0 q1 + p1 q0 + 2 p1 q1).
    // Without copies of the rows: on the largest meshes memory is what takes time.
    const auto row = [](const BrokenLinear& of, Eigen::Index side) {
        return of.row(side).transpose();
    };
    return (mesh.lengths / 6.0 *
            (row(p, 0) * (2.0 * row(q, 0) + row(q, 1)) + row(p, 1) * (row(q, 0) + 2.0 * row(q, 1))))
        .sum();
}

BrokenLinear broken(const Eigen::VectorXd& nodal) {
    const Eigen::Index s = nodal.size() - 1;
    BrokenLinear p(2, s);
    p.row(0) = nodal.head(s).transpose().array();
    p.row(1) = nodal.tail(s).transpose().array();
    return p;
}

BrokenLinear moment_arm(const Mesh& mesh) {
    return broken((1.0 - mesh.nodes).matrix());
}

Eigen::VectorXd hat_loads(const Mesh& mesh, const BrokenLinear& p) {
    const Eigen::Index s = mesh.elements();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(s + 1);
    const auto p0 = p.row(0).transpose();
    const auto p1 = p.row(1).transpose();
    loads.head(s).array() += mesh.lengths / 6.0 * (2.0 * p0 + p1);
    loads.tail(s).array() += mesh.lengths / 6.0 * (p0 + 2.0 * p1);
    return loads;
}

Eigen::VectorXd mass_times(const Mesh& mesh, ThermalMass mass, const Eigen::VectorXd& theta) {
    if (mass == ThermalMass::consistent)
        return hat_loads(mesh, broken(theta));
    const Eigen::Index s = mesh.elements();
    Eigen::ArrayXd row_sums = Eigen::ArrayXd::Zero(s + 1);
    row_sums.head(s) += mesh.lengths / 2.0;
    row_sums.tail(s) += mesh.lengths / 2.0;
    return (row_sums * theta.array()).matrix();
}

Load load_of(const Mesh& mesh, const SpaceFunction& g) {
    constexpr std::size_t points = 10;
    const std::unique_ptr<gsl_integration_glfixed_table,
                          decltype(&gsl_integration_glfixed_table_free)>
        rule(gsl_integration_glfixed_table_alloc(points), &gsl_integration_glfixed_table_free);
    if (!rule)
        throw std::bad_alloc();
    const Eigen::Index s = mesh.elements();
    Eigen::ArrayXd left = Eigen::ArrayXd::Zero(s); // moments with 1 − ξ and ξ, over h
    Eigen::ArrayXd right = Eigen::ArrayXd::Zero(s);
    for (std::size_t q = 0; q < points; ++q) {
        double xi = 0.0;
        double weight = 0.0;
        gsl_integration_glfixed_point(0.0, 1.0, q, &xi, &weight, rule.get());
        const Eigen::ArrayXd value = g(mesh.nodes.head(s) + xi * mesh.lengths);
        left += weight * (1.0 - xi) * value;
        right += weight * xi * value;
    }
    Load load{Eigen::VectorXd::Zero(s + 1), BrokenLinear(2, s)};
    load.hat.head(s) += (mesh.lengths * left).matrix();
    load.hat.tail(s) += (mesh.lengths * right).matrix();
    load.projection.row(0) = (4.0 * left - 2.0 * right).transpose();
    load.projection.row(1) = (4.0 * right - 2.0 * left).transpose();
    return load;
}

} // namespace tvbeam::certify
