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

/// ∫ p q dx.
double product(const Mesh& mesh, const BrokenLinear& p, const BrokenLinear& q);

/// The function with these values at the nodes (s + 1).
BrokenLinear broken(const Eigen::VectorXd& nodal);

/// The arm 1 − x of a force at the tip, about a point x.
BrokenLinear moment_arm(const Mesh& mesh);

/// (p, χ_i) for the hat functions of all nodes; shape: s + 1.
Eigen::VectorXd hat_loads(const Mesh& mesh, const BrokenLinear& p);

/// The mass matrix of the heat equation on nodal values that are zero at both ends; shape: s + 1,
/// of which the ends say nothing.
Eigen::VectorXd mass_times(const Mesh& mesh, ThermalMass mass, const Eigen::VectorXd& theta);

/// The load (g, χ_i) at all nodes (s + 1), and the L² projection of g on the broken functions, by
/// Gauss's rule of 10 points on each element.
struct Load {
    Eigen::VectorXd hat;
    BrokenLinear projection;
};
Load load_of(const Mesh& mesh, const SpaceFunction& g);

} // namespace tvbeam::certify
