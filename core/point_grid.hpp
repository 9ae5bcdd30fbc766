#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// Points (x_i, t_i) of space and time.
struct Points {
    Eigen::ArrayXd x, t;
};

/// All places at one time after the other: the place i at the time j is point j · places + i.
inline Points point_grid(const Eigen::ArrayXd& places, const Eigen::ArrayXd& times) {
    const Eigen::Index count = places.size();
    Points points{Eigen::ArrayXd(count * times.size()), Eigen::ArrayXd(count * times.size())};
    for (Eigen::Index j = 0; j < times.size(); ++j) {
        points.x.segment(j * count, count) = places;
        points.t.segment(j * count, count).setConstant(times(j));
    }
    return points;
}

} // namespace tvbeam
