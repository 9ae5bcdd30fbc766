#pragma once

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace tvbeam {

/// β of differences c s^β + d s, when that is below 1: from five distances s, each ten times the
/// one before, the nearest 1e-12 of a length, or a thousand steps of rounding of the place `at`
/// that they are taken from. What is left of two neighbours without d, v(10 s) − 10 v(s), is
/// c s^β (10^β − 10); the three ratios of these must give nearly the same β: with a logarithm, or
/// two powers of one size, it is one near theirs. Infinite where they do not, as beside a layer,
/// however thin, where β is not below 1, where the rest is rounding of the size, or where the
/// furthest would leave the length. difference: at a distance s > 0 with which at ± s is exact, at
/// one or more places, of which the one is looked at where the nearest two leave most.
template <typename Difference>
double power_below_one(const Difference& difference, double at, double length, double size) {
    constexpr double nearest = 1e-12;     // of the length
    constexpr double most_rounded = 1e-3; // of the distance
    constexpr double rounding = 1e-12;    // of the size
    constexpr double nearly_zero = 5e-3;  // where the value at zero is another one than the limit
    constexpr double nearly_one = 0.95;
    constexpr double same = 1e-2;
    constexpr std::size_t count = 5;
    const double infinity = std::numeric_limits<double>::infinity();
    const double step = std::numeric_limits<double>::epsilon() * std::abs(at);
    std::array<double, count> distance{};
    for (std::size_t k = 0; k < count; ++k)
        distance[k] =
            (at + std::max(nearest * length, step / most_rounded) * std::pow(10.0, k)) - at;
    if (2.0 * distance.back() > length) // beyond it stands something else
        return infinity;
    std::array<Eigen::ArrayXd, count> found;
    std::ranges::transform(distance, found.begin(), difference);
    const auto rest = [&](std::size_t k) -> Eigen::ArrayXd {
        return found[k + 1] - distance[k + 1] / distance[k] * found[k];
    };
    Eigen::Index place = 0;
    if (!(rest(0).abs().maxCoeff(&place) > rounding * size))
        return infinity;
    const auto beta = [&](std::size_t k) {
        return std::log(rest(k + 1)(place) / rest(k)(place)) / std::log(10.0);
    };
    const double result = beta(0);
    const double allowed = std::min(same, 0.1 * result);
    const bool is_power = result > nearly_zero && result < nearly_one &&
                          std::abs(beta(1) - result) < allowed &&
                          std::abs(beta(2) - result) < 2 * allowed;
    return is_power ? result : infinity;
}

/// To a hundredth, as it is known: "0.67".
inline std::string local_power_text(double power) {
    return fmt::format("{:g}", 0.01 * std::round(100.0 * power));
}

} // namespace tvbeam
