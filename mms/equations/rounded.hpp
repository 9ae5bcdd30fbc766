#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tvbeam {

/// A number with the first-order bound of what rounding makes of it, in units of the round-off, and
/// the size of the terms that it is made of: whether it is 0 can be told by these.
struct Rounded {
    static constexpr long double round_off = 64.0L * 0x1p-64L;

    long double value = 0.0L;
    long double bound = 0.0L;
    long double size = 0.0L; ///< of 3 - 1 it is 4; of a function what its argument's size makes

    Rounded() = default;
    // NOLINTNEXTLINE(google-explicit-constructor)
    Rounded(long double exact) : value(exact), bound(std::abs(exact)), size(std::abs(exact)) {}
    Rounded(long double value_, long double bound_, long double size_)
        : value(value_), bound(bound_), size(size_) {}

    /// Whether it is 0, as far as rounding can tell: it is within the bound, and its terms cancel
    /// in half of their digits at least, or are known far better than that. By a bound alone 2 +
    /// sin(1e22) would be, of which nothing is known. Nor is it where the bound is not finite, as
    /// of 1/0.
    [[nodiscard]] bool may_be_zero() const {
        constexpr long double half_of_the_digits = 0x1p-32L;
        constexpr long double well_known = 1e-4L; // as of sin(1e10 pi), of which fewer are left
        return value == 0.0L || (std::isfinite(bound) && std::abs(value) <= round_off * bound &&
                                 (std::abs(value) <= half_of_the_digits * size ||
                                  round_off * bound <= well_known * size));
    }

    /// What is between two numbers is off by no more than the farther one.
    [[nodiscard]] Rounded within(long double least, long double greatest) const {
        const long double most = std::max(value - least, greatest - value);
        return {value, bound <= most / round_off ? bound : most / round_off,
                std::min(size, std::max(-least, greatest))};
    }
};

inline Rounded operator+(const Rounded& a, const Rounded& b) {
    return {a.value + b.value, a.bound + b.bound + std::abs(a.value) + std::abs(b.value),
            a.size + b.size};
}
inline Rounded operator-(const Rounded& a) {
    return {-a.value, a.bound, a.size};
}
inline Rounded operator-(const Rounded& a, const Rounded& b) {
    return a + -b;
}
inline Rounded operator*(const Rounded& a, const Rounded& b) {
    const long double value = a.value * b.value;
    return {value, std::abs(a.value) * b.bound + std::abs(b.value) * a.bound + std::abs(value),
            a.size * b.size};
}
inline Rounded operator/(const Rounded& a, const Rounded& b) {
    const long double value = a.value / b.value;
    return {value, (a.bound + std::abs(value) * b.bound) / std::abs(b.value) + std::abs(value),
            a.size / std::abs(b.value)};
}

/// f(a) with f' there.
inline Rounded moved(const Rounded& a, long double value, long double slope) {
    return {value, std::abs(slope) * a.bound + std::abs(value),
            std::abs(slope) * a.size + std::abs(value)};
}

/// The same of a function that is 0 nowhere, however uncertain it is.
inline Rounded moved_off_zero(const Rounded& a, long double value, long double slope) {
    return {value, std::abs(slope) * a.bound + std::abs(value), std::abs(value)};
}

inline Rounded sqrt(const Rounded& a) {
    const long double root = std::sqrt(a.value);
    return {root, 0.5L / root * a.bound + root, std::sqrt(a.size)};
}
inline Rounded pow(const Rounded& a, const Rounded& b) {
    const long double value = std::pow(a.value, b.value);
    return {value,
            std::abs(value) * (1.0L + std::abs(b.value / a.value) * a.bound +
                               std::abs(std::log(std::abs(a.value))) * b.bound),
            b.value > 0.0L ? std::pow(a.size, b.value) : std::abs(value)};
}
inline Rounded sin(const Rounded& a) {
    return moved(a, std::sin(a.value), std::cos(a.value)).within(-1.0L, 1.0L);
}
inline Rounded cos(const Rounded& a) {
    return moved(a, std::cos(a.value), std::sin(a.value)).within(-1.0L, 1.0L);
}
inline Rounded tan(const Rounded& a) {
    return sin(a) / cos(a);
}
inline Rounded asin(const Rounded& a) {
    constexpr long double most = std::numbers::pi_v<long double> / 2.0L;
    return moved(a, std::asin(a.value), 1.0L / std::sqrt(1.0L - a.value * a.value))
        .within(-most, most);
}
inline Rounded acos(const Rounded& a) {
    return moved(a, std::acos(a.value), 1.0L / std::sqrt(1.0L - a.value * a.value))
        .within(0.0L, std::numbers::pi_v<long double>);
}
inline Rounded atan(const Rounded& a) {
    constexpr long double most = std::numbers::pi_v<long double> / 2.0L;
    return moved(a, std::atan(a.value), 1.0L / (1.0L + a.value * a.value)).within(-most, most);
}
inline Rounded sinh(const Rounded& a) {
    return moved(a, std::sinh(a.value), std::cosh(a.value));
}
inline Rounded cosh(const Rounded& a) {
    return moved_off_zero(a, std::cosh(a.value), std::sinh(a.value));
}
inline Rounded tanh(const Rounded& a) {
    const long double value = std::tanh(a.value);
    return moved(a, value, 1.0L - value * value).within(-1.0L, 1.0L);
}
inline Rounded exp(const Rounded& a) {
    return moved_off_zero(a, std::exp(a.value), std::exp(a.value));
}
inline Rounded log(const Rounded& a) {
    return moved(a, std::log(a.value), 1.0L / a.value);
}

} // namespace tvbeam
