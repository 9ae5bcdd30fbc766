#include "core/certify/piecewise_linear.hpp"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <memory>
#include <new>

namespace tvbeam::certify {

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
