#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// In space, and in time where both vary, what must hold everywhere is looked at in so many equally
/// distant points, the ends among them.
inline constexpr Eigen::Index grid_points = 33;

/// Those points of [begin, end].
inline Eigen::ArrayXd sample_points(double begin, double end) {
    return Eigen::ArrayXd::LinSpaced(grid_points, begin, end);
}

} // namespace tvbeam
