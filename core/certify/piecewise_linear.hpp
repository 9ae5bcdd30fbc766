/// Integrals of piecewise linear functions on a mesh, for certificates: written out once more, so
/// that a wrong one in core/space is noticed.
#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"
#include "core/space/thermal_mass.hpp"

#include <Eigen/Core>

namespace tvbeam::certify {

/// Without continuity: the values at the left and right end of every element; shape: 2 × s.
using BrokenLinear = Eigen::Array2Xd;

/// ∫ p q dx, of expressions too: on the largest meshes memory is what takes time.
template <typename P, typename Q>
double product(const Mesh& mesh, const Eigen::ArrayBase<P>& p, const Eigen::ArrayBase<Q>& q) {
    // Over an element of length h: h/6 (2 p0 q0 + p0 q1 + p1 q0 + 2 p1 q1).
    const auto p0 = p.row(0).transpose();
    const auto p1 = p.row(1).transpose();
    const auto q0 = q.row(0).transpose();
    const auto q1 = q.row(1).transpose();
    return (mesh.lengths / 6.0 * (p0 * (2.0 * q0 + q1) + p1 * (q0 + 2.0 * q1))).sum();
}

/// ∫ (1 − x) p dx: 1 − x is the arm of a force at the tip, about a point x.
template <typename P>
double tip_moment(const Mesh& mesh, const Eigen::ArrayBase<P>& p) {
    const Eigen::Index s = p.cols();
    const auto p0 = p.row(0).transpose();
    const auto p1 = p.row(1).transpose();
    return (mesh.lengths / 6.0 *
            ((1.0 - mesh.nodes.head(s)) * (2.0 * p0 + p1) +
             (1.0 - mesh.nodes.tail(s)) * (p0 + 2.0 * p1)))
        .sum();
}

/// (p, χ_i) for the hat functions of all nodes; shape: s + 1.
template <typename P>
Eigen::VectorXd hat_loads(const Mesh& mesh, const Eigen::ArrayBase<P>& p) {
    const Eigen::Index s = p.cols();
    const auto p0 = p.row(0).transpose();
    const auto p1 = p.row(1).transpose();
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(s + 1);
    loads.head(s).array() += mesh.lengths / 6.0 * (2.0 * p0 + p1);
    loads.tail(s).array() += mesh.lengths / 6.0 * (p0 + 2.0 * p1);
    return loads;
}

/// The mass matrix of the heat equation on nodal values, those at both ends included; shape: s + 1.
Eigen::VectorXd mass_times(const Mesh& mesh, ThermalMass mass, const Eigen::VectorXd& theta);

/// The load (g, χ_i) at all nodes (s + 1), and the L² projection of g on the broken functions, by
/// Gauss's rule of 10 points on each element.
struct Load {
    Eigen::VectorXd hat;
    BrokenLinear projection;
};
Load load_of(const Mesh& mesh, const SpaceFunction& g);

} // namespace tvbeam::certify
