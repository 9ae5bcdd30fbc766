#pragma once

#include "core/space/linear_elements.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// Functions by their values at the points of the rule (element_points) on every cell of a mesh;
/// shape: points × cells. What is done to them is done to the polynomials of degree 5 through them.
using PointValues = Eigen::ArrayXXd;

/// The function less the linear one that makes it vanish at both ends, and its first integral less
/// its mean: for y = g
///
///     first(x) = ∫_0^x g − tip,     second(x) = ∫_0^x (x − y) g dy − tip x,     tip = ∫ (1 − x) g
struct Antiderivatives {
    PointValues first;
    PointValues second;
    double tip = 0.0;
};
Antiderivatives antiderivatives(const Mesh& mesh, const PointValues& g);

/// (g, χ_i), i = 0 … s.
Eigen::VectorXd hat_loads(const Mesh& mesh, const PointValues& g);

/// The continuous piecewise linear function with these values at the nodes.
PointValues piecewise_linear(const Mesh& mesh, const Eigen::VectorXd& nodal);

/// The L² projection of g on P1disc.
DiscontinuousLinear project(const Mesh& mesh, const PointValues& g);

/// g less that.
PointValues without_projection(const Mesh& mesh, const PointValues& g);

/// The weights of the integral over [0, 1].
PointValues point_weights(const Mesh& mesh);

} // namespace tvbeam
