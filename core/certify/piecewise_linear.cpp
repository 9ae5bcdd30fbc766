#include "core/certify/piecewise_linear.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <memory>
#include <new>

namespace tvbeam::certify {

Eigen::VectorXd mass_times(const Mesh& mesh, ThermalMass mass, const Eigen::VectorXd& theta) {
    const Eigen::Index s = mesh.elements();
    if (mass == ThermalMass::consistent) {
        const auto v = theta.array();
        Eigen::VectorXd product = Eigen::VectorXd::Zero(s + 1);
        product.head(s).array() += mesh.lengths / 6.0 * (2.0 * v.head(s) + v.tail(s));
        product.tail(s).array() += mesh.lengths / 6.0 * (v.head(s) + 2.0 * v.tail(s));
        return product;
    }
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
    Load load{Eigen::VectorXd::Zero(s + 1), BrokenLinear(2, s)};
    constexpr Eigen::Index block = 1024; // elements, whose values a processor keeps at hand
    for (Eigen::Index first = 0; first < s; first += block) {
        const Eigen::Index n = std::min(block, s - first);
        const auto nodes = mesh.nodes.segment(first, n);
        const auto lengths = mesh.lengths.segment(first, n);
        Eigen::ArrayXd left = Eigen::ArrayXd::Zero(n); // moments with 1 − ξ and ξ, over h
        Eigen::ArrayXd right = Eigen::ArrayXd::Zero(n);
        for (std::size_t q = 0; q < points; ++q) {
            double xi = 0.0;
            double weight = 0.0;
            gsl_integration_glfixed_point(0.0, 1.0, q, &xi, &weight, rule.get());
            const Eigen::ArrayXd value = g(nodes + xi * lengths);
            left += weight * (1.0 - xi) * value;
            right += weight * xi * value;
        }
        load.hat.segment(first, n) += (lengths * left).matrix();
        load.hat.segment(first + 1, n) += (lengths * right).matrix();
        load.projection.row(0).segment(first, n) = (4.0 * left - 2.0 * right).transpose();
        load.projection.row(1).segment(first, n) = (4.0 * right - 2.0 * left).transpose();
    }
    return load;
}

} // namespace tvbeam::certify
