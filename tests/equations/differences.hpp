#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <functional>
#include <vector>

namespace tvbeam::testing {

/// A hundred digits: of four nested differences of the step h sixty are left, and their error is of
/// the order of h² = 1e-20.
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                           boost::multiprecision::et_off>;
using Point = std::array<Real, 4>; ///< x, y, z, t
using Function = std::function<Real(const Point&)>;
using Vector = std::vector<Function>;
using Matrix = std::vector<Vector>;

/// The central difference in the coordinate i: what no algebra has touched.
inline Function d(Function f, std::size_t i) {
    return [f = std::move(f), i](const Point& p) {
        const Real h("1e-10");
        Point above = p;
        Point below = p;
        above[i] += h;
        below[i] -= h;
        return Real((f(above) - f(below)) / (2 * h));
    };
}
inline Function d(const Function& f, std::size_t i, std::size_t j) {
    return d(d(f, i), j);
}

inline Function operator+(Function a, Function b) {
    return [a = std::move(a), b = std::move(b)](const Point& p) { return Real(a(p) + b(p)); };
}
inline Function operator-(Function a, Function b) {
    return [a = std::move(a), b = std::move(b)](const Point& p) { return Real(a(p) - b(p)); };
}
inline Function operator*(Function a, Function b) {
    return [a = std::move(a), b = std::move(b)](const Point& p) { return Real(a(p) * b(p)); };
}
inline Function operator*(const Real& a, Function b) {
    return [a, b = std::move(b)](const Point& p) { return Real(a * b(p)); };
}
inline Function operator/(Function a, Function b) {
    return [a = std::move(a), b = std::move(b)](const Point& p) { return Real(a(p) / b(p)); };
}

} // namespace tvbeam::testing
