#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"
#include "core/space/thermal_mass.hpp"
#include "core/space/tridiagonal.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// Matrices of the hat functions χ_1 … χ_{s−1} of S_0^h (zero at both ends); order s − 1.
Tridiagonal thermal_mass_matrix(const Mesh& mesh, ThermalMass kind);
Tridiagonal stiffness_matrix(const Mesh& mesh); ///< (χ_i', χ_j')

/// Piecewise linear functions without continuity, P1disc: the values at the left and right end of
/// every element; shape: 2 × s.
using DiscontinuousLinear = Eigen::Array2Xd;

/// (g, χ_i) for the hat functions χ_0 … χ_s of all nodes, from g at element_points; shape: s + 1.
/// Exact for polynomials of degree 10 on each cell.
Eigen::VectorXd hat_loads(const Mesh& mesh, const SpaceFunction& g);

/// (p, χ_i) of a piecewise linear p; exact. shape: s + 1
Eigen::VectorXd hat_loads(const Mesh& mesh, const DiscontinuousLinear& p);

/// ∫ (1 − x) p dx of a piecewise linear p; exact.
double tip_moment(const Mesh& mesh, const DiscontinuousLinear& p);

/// (p, q) of two piecewise linear functions; exact.
double inner_product(const Mesh& mesh, const DiscontinuousLinear& p, const DiscontinuousLinear& q);

/// The L² projection of g on P1disc: the projection of (25)'s space for curvatures.
DiscontinuousLinear project(const Mesh& mesh, const SpaceFunction& g);

/// ‖v‖² of the continuous piecewise linear function with nodal values v (s + 1), through the
/// consistent mass matrix.
double squared_norm(const Mesh& mesh, const Eigen::VectorXd& v);

} // namespace tvbeam
