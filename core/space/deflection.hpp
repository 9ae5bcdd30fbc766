#pragma once

#include "core/space/linear_elements.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// The cubic U of S_E^h at the nodes; shape: s + 1 each.
struct Deflection {
    Eigen::VectorXd value; ///< U(x_i)
    Eigen::VectorXd slope; ///< U_x(x_i)
};

/// U from its curvature w = U_xx: U_x = ∫_0^x w, U = ∫_0^x (x − y) w dy, clamped at x = 0 (5);
/// exact.
Deflection deflection(const Mesh& mesh, const DiscontinuousLinear& curvature);

/// The curvature of the cubic with nodal values U and slopes U_x; the inverse of deflection(). Its
/// round-off grows like h⁻² times that of U.
DiscontinuousLinear curvature(const Mesh& mesh, const Deflection& nodal);

} // namespace tvbeam
