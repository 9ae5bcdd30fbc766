#pragma once

#include <cmath>
#include <string>

namespace tvbeam {

/// A number with the first-order bound of what rounding makes of it, in units of the round-off:
/// whether it is 0 can be told by it.
struct Rounded {
    long double value = 0.0L;
    long double bound = 0.0L;

    Rounded() = default;
    // NOLINTNEXTLINE(google-explicit-constructor)
    Rounded(long double exact) : value(exact), bound(std::abs(exact)) {}
    Rounded(long double value_, long double bound_) : value(value_), bound(bound_) {}

    /// Whether it is 0, as far as rounding can tell. Of a value whose bound is not finite, as of
    /// acos at -1, nothing is known, and it is not said to be 0.
    [[nodiscard]] bool may_be_zero() const {
        constexpr long double round_off = 64.0L * 0x1p-64L;
        return value == 0.0L || (std::isfinite(bound) && std::abs(value) <= round_off * bound);
    }
};

inline Rounded operator+(const Rounded& a, const Rounded& b) {
    return {a.value + b.value, a.bound + b.bound + std::abs(a.value) + std::abs(b.value)};
}
inline Rounded operator-(const Rounded& a) {
    return {-a.value, a.bound};
}
inline Rounded operator-(const Rounded& a, const Rounded& b) {
    return a + -b;
}
inline Rounded operator*(const Rounded& a, const Rounded& b) {
    const long double value = a.value * b.value;
    return {value, std::abs(a.value) * b.bound + std::abs(b.value) * a.bound + std::abs(value)};
}
inline Rounded operator/(const Rounded& a, const Rounded& b) {
    const long double value = a.value / b.value;
    return {value, (a.bound + std::abs(value) * b.bound) / std::abs(b.value) + std::abs(value)};
}

/// f(a) with f' there.
inline Rounded moved(const Rounded& a, long double value, long double slope) {
    return {value, std::abs(slope) * a.bound + std::abs(value)};
}

inline Rounded sqrt(const Rounded& a) {
    const long double root = std::sqrt(a.value);
    return moved(a, root, 0.5L / root);
}
inline Rounded pow(const Rounded& a, const Rounded& b) {
    const long double value = std::pow(a.value, b.value);
    return {value, std::abs(value) * (1.0L + std::abs(b.value / a.value) * a.bound +
                                      std::abs(std::log(std::abs(a.value))) * b.bound)};
}
inline Rounded sin(const Rounded& a) {
    return moved(a, std::sin(a.value), std::cos(a.value));
}
inline Rounded cos(const Rounded& a) {
    return moved(a, std::cos(a.value), std::sin(a.value));
}
inline Rounded tan(const Rounded& a) {
    const long double value = std::tan(a.value);
    return moved(a, value, 1.0L + value * value);
}
inline Rounded asin(const Rounded& a) {
    return moved(a, std::asin(a.value), 1.0L / std::sqrt(1.0L - a.value * a.value));
}
inline Rounded acos(const Rounded& a) {
    return moved(a, std::acos(a.value), 1.0L / std::sqrt(1.0L - a.value * a.value));
}
inline Rounded atan(const Rounded& a) {
    return moved(a, std::atan(a.value), 1.0L / (1.0L + a.value * a.value));
}
inline Rounded sinh(const Rounded& a) {
    return moved(a, std::sinh(a.value), std::cosh(a.value));
}
inline Rounded cosh(const Rounded& a) {
    return moved(a, std::cosh(a.value), std::sinh(a.value));
}
inline Rounded tanh(const Rounded& a) {
    const long double value = std::tanh(a.value);
    return moved(a, value, 1.0L - value * value);
}
inline Rounded exp(const Rounded& a) {
    return moved(a, std::exp(a.value), std::exp(a.value));
}
inline Rounded log(const Rounded& a) {
    return moved(a, std::log(a.value), 1.0L / a.value);
}

} // namespace tvbeam
