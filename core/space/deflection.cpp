#include "core/space/deflection.hpp"

namespace tvbeam {

Deflection deflection(const Mesh& mesh, const DiscontinuousLinear& curvature) {
    const Eigen::Index s = mesh.elements();
    Deflection nodal{Eigen::VectorXd::Zero(s + 1), Eigen::VectorXd::Zero(s + 1)};
    for (Eigen::Index j = 0; j < s; ++j) {
        const double h = mesh.lengths(j);
        const double left = curvature(0, j);
        const double right = curvature(1, j);
        nodal.value(j + 1) = nodal.value(j) + h * (nodal.slope(j) + h * (2.0 * left + right) / 6.0);
        nodal.slope(j + 1) = nodal.slope(j) + h * (left + right) / 2.0;
    }
    return nodal;
}

DiscontinuousLinear curvature(const Mesh& mesh, const Deflection& nodal) {
    const Eigen::Index s = mesh.elements();
    const Eigen::ArrayXd chord = (nodal.value.tail(s) - nodal.value.head(s)).array() / mesh.lengths;
    const auto left = nodal.slope.head(s).array();
    const auto right = nodal.slope.tail(s).array();
    DiscontinuousLinear w(2, s);
    w.row(0) = ((6.0 * chord - 4.0 * left - 2.0 * right) / mesh.lengths).transpose();
    w.row(1) = ((2.0 * left + 4.0 * right - 6.0 * chord) / mesh.lengths).transpose();
    return w;
}

} // namespace tvbeam
