#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// Points (x_i, t_i) of space and time.
struct Points {
    Eigen::ArrayXd x, t;
};

/// All places at one time after the other: the place i at the time j is point j · places + i.
inline Points point_grid(const Eigen::ArrayXd& places, const Eigen::ArrayXd& times) {
    return {places.replicate(times.size(), 1),
            times.transpose().replicate(places.size(), 1).reshaped()};
}

} // namespace tvbeam
