#pragma once

#include "mms/sample_points.hpp"

#include <Eigen/Core>

#include <functional>

namespace tvbeam {

/// A function at the points (x_i, t_i).
using PointFunction =
    std::function<Eigen::ArrayXd(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t)>;

/// Where |g| is as large as was seen, and how large that is; size 0: zero everywhere it was looked
/// at.
struct LargestPoint {
    double x = 0.0, t = 0.0, size = 0.0;
};

/// The largest |g| for x and t of two intervals, either of which may be one point. It is seen on a
/// grid that is finer towards the begin and the end of the time, and at points of which no two have
/// the same x or t: a peak that moves, or stands between the lines of the grid, has some of them
/// beside it. Next to the largest ones of several parts of the region it is looked at ever more
/// closely. Where g is not finite it counts as zero.
LargestPoint largest_point(const PointFunction& g, const CloseLook& x, const CloseLook& t);

/// Its size.
double largest_size(const PointFunction& g, const CloseLook& x, const CloseLook& t);

} // namespace tvbeam
