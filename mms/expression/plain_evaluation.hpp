#pragma once

#include "mms/expression/bounded_jet.hpp"
#include "mms/expression/plain_expression.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace tvbeam {

// Expressions with their derivatives in x and t, evaluated as they are written: no algebra, no
// rewriting, no doubles. What the tapes of derived expressions are compared with. `Real` is long
// double, or a type of more digits.

/// A decimal, rounded to Real.
template <typename Real>
Real decimal(const std::string& text) {
    if constexpr (std::is_floating_point_v<Real>) {
        Real value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    } else {
        return Real(text);
    }
}

/// The Taylor coefficients of a function of one variable at a point, and for each the sum of the
/// sizes of the terms that it is computed from. Two more than the highest order of a jet.
template <typename Real>
struct Series {
    static constexpr std::size_t size = BoundedJet<Real>::most_x + BoundedJet<Real>::most_t + 3;
    std::array<Real, size> coefficients{};
    std::array<Real, size> sizes{};
};

/// f(b): the series of f at b's value, in powers of the rest of b.
template <typename Real>
BoundedJet<Real> composed(const Series<Real>& f, const BoundedJet<Real>& b) {
    const auto coefficient = [&](int k) {
        const auto at = static_cast<std::size_t>(k);
        // An error of b's value moves the coefficient by the next one, and by the one after that
        // where it is large: cos(1e20) has no digit right.
        const Real error = b.at(0, 0).bound;
        Real moved = 0;
        if (error != 0) // one that is not known moves it by what is not known
            moved = (k + 1) * error *
                    (f.sizes[at + 1] + f.sizes[at + 2] * error * (k + 2) * Real(0x1p-54));
        return Bounded<Real>{f.coefficients[at], f.sizes[at] + moved};
    };
    BoundedJet<Real> rest = b;
    rest.at(0, 0) = {};
    const int orders = b.x_orders + b.t_orders;
    BoundedJet<Real> result(coefficient(orders));
    for (int k = orders - 1; k >= 0; --k)
        result = result * rest + BoundedJet<Real>(coefficient(k));
    return result;
}

template <typename Real>
Series<Real> with_sizes(Series<Real> f) {
    using std::abs;
    for (std::size_t k = 0; k < f.size; ++k)
        f.sizes[k] = abs(f.coefficients[k]);
    return f;
}

/// A function whose derivatives of orders 0, 1, 2, 3, 4, … are a, b, ±a, ±b, a, …
template <typename Real>
Series<Real> alternating(const Real& a, const Real& b, int sign) {
    Series<Real> f;
    Real factorial = 1;
    for (std::size_t k = 0; k < f.size; ++k) {
        factorial *= k == 0 ? 1 : static_cast<int>(k);
        f.coefficients[k] = (k % 4 < 2 ? 1 : sign) * (k % 2 == 0 ? a : b) / factorial;
    }
    return with_sizes(f);
}

/// b^a for a constant a: (a choose k) b^(a-k).
template <typename Real>
Series<Real> power_series(const Real& b, const Real& a) {
    using std::abs;
    using std::pow;
    Series<Real> f;
    Real choose = 1;
    Real power = pow(b, a);
    for (std::size_t k = 0; k < f.size && choose != 0; ++k) {
        const Real order = static_cast<int>(k);
        f.coefficients[k] = choose * power;
        // By products a^n has n roundings.
        f.sizes[k] = (abs(a) + 1) * abs(f.coefficients[k]);
        choose *= (a - order) / (order + 1);
        power = b == 0 ? Real(pow(b, Real(a - order - 1))) : Real(power / b);
    }
    return f;
}

template <typename Real>
Series<Real> logarithm(const Real& b) {
    using std::log;
    Series<Real> f;
    f.coefficients[0] = log(b);
    Real power = -1;
    for (std::size_t k = 1; k < f.size; ++k) {
        power /= -b;
        f.coefficients[k] = power / static_cast<int>(k);
    }
    return with_sizes(f);
}

/// y with y' = 1 + sign y²: tan, tanh.
template <typename Real>
Series<Real> tangent(const Real& value, int sign) {
    using std::abs;
    Series<Real> y;
    y.coefficients[0] = value;
    y.sizes[0] = abs(value);
    for (std::size_t k = 0; k + 1 < y.size; ++k) {
        Real square = 0;
        Real size = k == 0 ? 1 : 0;
        for (std::size_t i = 0; i <= k; ++i) {
            square += y.coefficients[i] * y.coefficients[k - i];
            size += y.sizes[i] * y.sizes[k - i];
        }
        const int order = static_cast<int>(k) + 1;
        y.coefficients[k + 1] = ((k == 0 ? 1 : 0) + sign * square) / order;
        y.sizes[k + 1] = size / order;
    }
    return y;
}

/// y with y' = (1 - b²)^(-1/2): (1 - b²) y'' = b y'.
template <typename Real>
Series<Real> arcsine(const Real& b) {
    using std::abs;
    using std::asin;
    using std::sqrt;
    Series<Real> y;
    const Real below = (1 - b) * (1 + b);
    y.coefficients[0] = asin(b);
    y.coefficients[1] = 1 / sqrt(below);
    y.sizes[0] = abs(y.coefficients[0]);
    y.sizes[1] = y.coefficients[1] * (1 + b * b) / below;
    for (std::size_t k = 0; k + 2 < y.size; ++k) {
        const int n = static_cast<int>(k);
        const Real first = (2 * n + 1) * b / ((n + 2) * below);
        const Real second = Real(n * n) / ((n + 1) * (n + 2) * below);
        y.coefficients[k + 2] = first * y.coefficients[k + 1] + second * y.coefficients[k];
        y.sizes[k + 2] = abs(first) * y.sizes[k + 1] + second * y.sizes[k];
    }
    return y;
}

/// y with (1 + b²) y' = 1.
template <typename Real>
Series<Real> arctangent(const Real& b) {
    using std::abs;
    using std::atan;
    Series<Real> y;
    const Real below = 1 + b * b;
    y.coefficients[0] = atan(b);
    y.coefficients[1] = 1 / below;
    y.sizes[0] = abs(y.coefficients[0]);
    y.sizes[1] = y.coefficients[1];
    for (std::size_t k = 1; k + 1 < y.size; ++k) {
        const int n = static_cast<int>(k);
        const Real first = 2 * b * n / ((n + 1) * below);
        const Real second = Real(n - 1) / ((n + 1) * below);
        y.coefficients[k + 1] = -first * y.coefficients[k] - second * y.coefficients[k - 1];
        y.sizes[k + 1] = abs(first) * y.sizes[k] + second * y.sizes[k - 1];
    }
    return y;
}

template <typename Real>
BoundedJet<Real> plain_function(const std::string& name, const BoundedJet<Real>& argument) {
    using std::acos, std::cos, std::cosh, std::exp, std::sin, std::sinh, std::tan, std::tanh;
    const Real b = argument.at(0, 0).value;
    const auto of = [&](const Series<Real>& f) { return composed(f, argument); };
    if (name == "sin")
        return of(alternating<Real>(sin(b), cos(b), -1));
    if (name == "cos")
        return of(alternating<Real>(cos(b), -sin(b), -1));
    if (name == "sinh")
        return of(alternating<Real>(sinh(b), cosh(b), 1));
    if (name == "cosh")
        return of(alternating<Real>(cosh(b), sinh(b), 1));
    if (name == "exp")
        return of(alternating<Real>(exp(b), exp(b), 1));
    if (name == "log")
        return of(logarithm(b));
    if (name == "tan")
        return of(tangent<Real>(tan(b), 1));
    if (name == "tanh")
        return of(tangent<Real>(tanh(b), -1));
    if (name == "atan")
        return of(arctangent(b));
    if (name == "sqrt")
        return of(power_series(b, Real(Real(1) / 2)));
    Series<Real> f = arcsine(b);
    if (name == "acos") {
        for (Real& coefficient : f.coefficients)
            coefficient = -coefficient;
        f.coefficients[0] = acos(b);
        f.sizes[0] += 1;
    } else if (name != "asin") {
        throw std::invalid_argument("plain_function: " + name);
    }
    return of(f);
}

template <typename Real>
BoundedJet<Real> plain_power(const BoundedJet<Real>& base, const BoundedJet<Real>& exponent) {
    if (exponent.x_orders == 0 && exponent.t_orders == 0)
        return composed(power_series(base.at(0, 0).value, exponent.at(0, 0).value), base);
    return plain_function("exp", exponent * plain_function("log", base));
}

/// The value with its derivatives. `names`: of all symbols that occur, pi among them.
template <typename Real>
BoundedJet<Real> evaluated(const PlainExpression& expression,
                           const std::map<std::string, BoundedJet<Real>>& names) {
    using std::abs;
    using Kind = PlainStep::Kind;
    std::vector<BoundedJet<Real>> stack;
    const auto pop = [&stack] {
        BoundedJet<Real> top = stack.back();
        stack.pop_back();
        return top;
    };
    const auto binary = [&](Kind kind, const BoundedJet<Real>& a, const BoundedJet<Real>& b) {
        switch (kind) {
        case Kind::Add:
            return a + b;
        case Kind::Subtract:
            return a + -b;
        case Kind::Multiply:
            return a * b;
        case Kind::Divide:
            return a * composed(power_series(b.at(0, 0).value, Real(-1)), b);
        default:
            return plain_power(a, b);
        }
    };
    for (const PlainStep& step : expression) {
        if (step.kind == Kind::Number) {
            const Real value = decimal<Real>(step.text);
            stack.push_back(BoundedJet<Real>(Bounded<Real>{value, abs(value)}));
        } else if (step.kind == Kind::Name) {
            stack.push_back(names.at(step.text));
        } else if (step.kind == Kind::Negate) {
            stack.back() = -stack.back();
        } else if (step.kind == Kind::Function) {
            stack.back() = plain_function(step.text, stack.back());
        } else {
            const BoundedJet<Real> right = pop();
            stack.back() = binary(step.kind, stack.back(), right);
        }
    }
    return stack.back();
}

} // namespace tvbeam
