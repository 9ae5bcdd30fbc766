#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tvbeam {

/// β of a difference that goes to zero like s^β as s does, when that is below 1: from 1e-12 and
/// 1e-10 of a length. It must not be less at 1e-8, as beside a layer, to which the slope is finite;
/// more it may be, where what is smooth is large: of c s^β + d s the three give β itself. Infinite
/// when it is not below 1, or when the difference is rounding of the size. difference: at a
/// distance s > 0, absolute.
template <typename Difference>
double power_below_one(const Difference& difference, double length, double size) {
    constexpr double ratio = 100;
    constexpr double nearest = 1e-12; // of the length
    constexpr double rounding =
        1e-12; // of the size; what is smooth is nearest · length · its slope
    constexpr double nearly_one = 0.95;
    constexpr double same = 0.05;
    constexpr double nearly_zero = 1e-3; // where the value at zero is another one than the limit
    const double near = difference(nearest * length);
    const double further = difference(nearest * ratio * length);
    const double far = difference(nearest * ratio * ratio * length);
    const double beta = std::log(further / near) / std::log(ratio);
    const double beta_further = std::log(far / further) / std::log(ratio);
    const bool is_power = near > rounding * size && beta > nearly_zero && beta < nearly_one &&
                          beta_further > beta - std::min(same, 0.5 * beta);
    if (!is_power)
        return std::numeric_limits<double>::infinity();
    const double without_smooth =
        std::log((far - ratio * further) / (further - ratio * near)) / std::log(ratio);
    return std::abs(without_smooth - beta) < same ? without_smooth : beta;
}

/// To a hundredth, as it is known: "0.67".
inline std::string local_power_text(double power) {
    return fmt::format("{:g}", 0.01 * std::round(100.0 * power));
}

} // namespace tvbeam
