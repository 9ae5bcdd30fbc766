#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace tvbeam {

/// In space, and in time where both vary, what must hold everywhere is looked at in so many equally
/// distant points, the ends among them.
inline constexpr Eigen::Index grid_points = 33;

/// Those points of [begin, end].
inline Eigen::ArrayXd sample_points(double begin, double end) {
    return Eigen::ArrayXd::LinSpaced(grid_points, begin, end);
}

/// An interval that closes in on a point between the samples of a coarser look.
struct CloseLook {
    double begin, end;

    /// Equally distant, the ends among them; one where both ends are the same.
    [[nodiscard]] Eigen::ArrayXd samples() const {
        constexpr Eigen::Index count = 9;
        return Eigen::ArrayXd::LinSpaced(begin < end ? count : 1, begin, end);
    }

    /// The part of it that is no further than this from a point of it.
    [[nodiscard]] CloseLook next_to(double point, double distance) const {
        return {std::max(begin, point - distance), std::min(end, point + distance)};
    }

    /// The distance of two samples.
    [[nodiscard]] double spacing() const { return 0.125 * (end - begin); }
};

} // namespace tvbeam
