#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tvbeam {

/// β of a difference that goes to zero like s^β as s does, when that is below 1: from 1e-12 and
/// 1e-10 of a length. It must not be less at 1e-8, as beside a layer, to which the slope is finite;
/// more it may be, where what is smooth is large. Of c s^β + d s three give β itself, and where d
/// makes it less, it must be the same of another three. Infinite when it is not below 1, or when
/// the difference is rounding of the size. difference: at a distance s > 0, absolute.
template <typename Difference>
double power_below_one(const Difference& difference, double length, double size) {
    constexpr double ratio = 100;
    constexpr double nearest = 1e-12; // of the length
    constexpr double rounding =
        1e-12; // of the size; what is smooth is nearest · length · its slope
    constexpr double nearly_one = 0.95;
    constexpr double same = 0.05;
    constexpr double nearly_zero = 1e-3; // where the value at zero is another one than the limit
    const auto allowed = [&](double beta) { return std::min(same, 0.5 * beta); };
    const auto is_below_one = [](double beta) { return beta > nearly_zero && beta < nearly_one; };
    const double near = difference(nearest * length);
    const double further = difference(nearest * ratio * length);
    const double far = difference(nearest * ratio * ratio * length);
    const double beta = std::log(further / near) / std::log(ratio);
    const double beta_further = std::log(far / further) / std::log(ratio);
    if (!(near > rounding * size) || !is_below_one(beta))
        return std::numeric_limits<double>::infinity();
    // c s^β + d s at distances of one ratio r: without the latter, c s^β (r^β − r).
    const auto without_slope = [](double one, double next, double last, double apart) {
        return std::log((last - apart * next) / (next - apart * one)) / std::log(apart);
    };
    if (beta_further > beta - allowed(beta)) {
        const double exact = without_slope(near, further, far, ratio);
        return std::abs(exact - beta) < same ? exact : beta;
    }
    constexpr double closer = 10;
    const double between = difference(nearest * closer * length);
    const double beyond = difference(nearest * closer * ratio * length);
    const double exact = without_slope(near, between, further, closer);
    const double same_further = without_slope(between, further, beyond, closer);
    const bool is_power = std::abs(between - closer * near) > rounding * size &&
                          is_below_one(exact) && std::abs(same_further - exact) < allowed(exact);
    return is_power ? exact : std::numeric_limits<double>::infinity();
}

/// To a hundredth, as it is known: "0.67".
inline std::string local_power_text(double power) {
    return fmt::format("{:g}", 0.01 * std::round(100.0 * power));
}

} // namespace tvbeam
