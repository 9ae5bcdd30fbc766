#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// Gauss–Legendre rule on [0, 1]: exact for polynomials of degree 2·points − 1.
struct GaussRule {
    Eigen::ArrayXd points;  ///< ξ_q in (0, 1)
    Eigen::ArrayXd weights; ///< sum 1

    static GaussRule of(Eigen::Index points);
};

/// The rule of every load and every error norm: degree 11 on each element, so that on ten elements
/// the quadrature error of sin πx lies below round-off. What it cannot integrate on an element is
/// integrated on the cells of it (Resolution).
const GaussRule& element_rule();
inline constexpr int element_rule_size = 6;

/// The quadrature points of elements first … first + count − 1; shape: one column a cell.
Eigen::ArrayXXd element_points(const Mesh& mesh, Eigen::Index first, Eigen::Index count);

/// φ at element_points; shape as there.
Eigen::ArrayXXd at_points(const SpaceFunction& phi, const Eigen::ArrayXXd& points);

/// Elements of the mesh in runs that keep temporary arrays in cache: visit(first, count).
template <typename Visit>
void for_each_block(const Mesh& mesh, Visit visit) {
    constexpr Eigen::Index block = 1024;
    for (Eigen::Index first = 0; first < mesh.elements(); first += block)
        visit(first, std::min(block, mesh.elements() - first));
}

} // namespace tvbeam
