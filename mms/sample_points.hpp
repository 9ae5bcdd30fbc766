#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace tvbeam {

/// In space, and in time where both vary, what must hold everywhere is looked at in so many points.
inline constexpr Eigen::Index grid_points = 33;

/// So many points of [begin, end], an odd number, in order: its ends and its middle, where
/// solutions are greatest most often, and others at uneven distances, 0.8 to 1.3 times the mean. At
/// points of one distance, sin(n pi x) is 0 for every multiple n of their number: something that is
/// wrong by it would be right there. What is uneven are the fractional parts of the multiples of
/// the golden ratio, which are as far from all simple fractions as can be.
inline Eigen::ArrayXd sample_points(double begin, double end, Eigen::Index count = grid_points) {
    constexpr double golden_ratio = 0.6180339887498949;
    constexpr double uneven = 0.5; // of the mean distance
    const double last = static_cast<double>(count - 1);
    Eigen::ArrayXd points = Eigen::ArrayXd::LinSpaced(count, 0.0, last);
    const Eigen::ArrayXd multiples = points * golden_ratio;
    points =
        begin + (points + uneven * (multiples - multiples.floor() - 0.5)) / last * (end - begin);
    points(0) = begin;
    points(count / 2) = begin + 0.5 * (end - begin);
    points(count - 1) = end;
    return points;
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
