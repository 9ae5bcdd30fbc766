#pragma once

#include "core/problem.hpp"
#include "core/space/cells.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// ∫_y^1 (x − y) q(x) dx at every y in [0, 1], by the rule of six points on intervals that resolve
/// q (Resolution::intervals), cut off at y.
Eigen::ArrayXd tail_moment(const std::vector<Interval>& intervals, const SpaceFunction& q,
                           const Eigen::ArrayXd& y);

} // namespace tvbeam
