#pragma once

#include <cmath>
#include <limits>

namespace tvbeam {

/// β of a difference that goes to zero like s^β as s does, from two small parts of a length, when
/// that is below 1; infinite when it is not, or when the difference there is rounding of the size.
/// difference: at a distance s > 0, absolute.
template <typename Difference>
double power_below_one(const Difference& difference, double length, double size) {
    constexpr double far = 1e-6; // of the length
    constexpr double near = 1e-8;
    constexpr double rounding = 1e-12; // of the size; what is smooth is near · length · its slope
    constexpr double nearly_one = 0.95;
    const double small = difference(near * length);
    const double large = difference(far * length);
    const double beta = std::log(large / small) / std::log(far / near);
    return small > rounding * size && beta < nearly_one ? beta
                                                        : std::numeric_limits<double>::infinity();
}

} // namespace tvbeam
