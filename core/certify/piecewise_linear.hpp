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

/// ∫ p q dx of what is linear on every element, from the values at the ends of the elements; of
/// expressions, here and below: on the largest meshes memory is what takes time.
template <typename P0, typename P1, typename Q0, typename Q1>
double product(const Mesh& mesh, const P0& p0, const P1& p1, const Q0& q0, const Q1& q1) {
    // Over an element of length h: h/6 (2 p0 q0 + p0 q1 + p1 q0 + 2 p1 q1).
    return (mesh.lengths / 6.0 * (p0 * (2.0 * q0 + q1) + p1 * (q0 + 2.0 * q1))).sum();
}

template <typename P, typename Q>
double product(const Mesh& mesh, const Eigen::ArrayBase<P>& p, const Eigen::ArrayBase<Q>& q) {
    return product(mesh, p.row(0).transpose(), p.row(1).transpose(), q.row(0).transpose(),
                   q.row(1).transpose());
}

/// pᵀMq with the mass matrix of the heat equation, of nodal values, those at both ends included.
template <typename P, typename Q>
double mass_product(const Mesh& mesh, ThermalMass mass, const Eigen::MatrixBase<P>& p,
                    const Eigen::MatrixBase<Q>& q) {
    const Eigen::Index s = mesh.elements();
    const auto p0 = p.head(s).array();
    const auto p1 = p.tail(s).array();
    const auto q0 = q.head(s).array();
    const auto q1 = q.tail(s).array();
    if (mass == ThermalMass::consistent)
        return product(mesh, p0, p1, q0, q1);
    return (mesh.lengths / 2.0 * (p0 * q0 + p1 * q1)).sum();
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

/// (p, χ_i) for the hat functions of the inner nodes, from the values at the ends of the elements:
/// an expression, shape: s − 1.
template <typename P0, typename P1>
auto hat_loads(const Mesh& mesh, const P0& p0, const P1& p1) {
    const Eigen::Index inner = mesh.elements() - 1;
    const auto sixth = mesh.lengths / 6.0;
    return sixth.tail(inner) * (2.0 * p0.tail(inner) + p1.tail(inner)) +
           sixth.head(inner) * (p0.head(inner) + 2.0 * p1.head(inner));
}

/// The load (g, χ_i) at all nodes (s + 1), and the L² projection of g on the broken functions, by
/// Gauss's rule of 10 points on each element.
struct Load {
    Eigen::VectorXd hat;
    BrokenLinear projection;
};
Load load_of(const Mesh& mesh, const SpaceFunction& g);

} // namespace tvbeam::certify
