#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tvbeam {

/// A number with a bound, to first order, of the error that arithmetic in doubles may make of it,
/// in units of the double's round-off 2^-53.
template <typename Real>
struct Bounded {
    Real value = 0;
    Real bound = 0;
};

template <typename Real>
Bounded<Real> operator+(const Bounded<Real>& a, const Bounded<Real>& b) {
    using std::abs;
    // |a| + |b| and not |a + b|: a sum of several terms may be taken in any order.
    return {a.value + b.value, a.bound + b.bound + abs(a.value) + abs(b.value)};
}
template <typename Real>
Bounded<Real> operator-(const Bounded<Real>& a) {
    return {-a.value, a.bound};
}
template <typename Real>
Bounded<Real> operator-(const Bounded<Real>& a, const Bounded<Real>& b) {
    return a + -b;
}
template <typename Real>
Bounded<Real> operator*(const Bounded<Real>& a, const Bounded<Real>& b) {
    using std::abs;
    return {a.value * b.value,
            abs(a.value) * b.bound + a.bound * abs(b.value) + abs(a.value * b.value)};
}

/// A function of x and t near a point: its Taylor coefficients ∂_x^i ∂_t^j / (i! j!) for i ≤ 3 and
/// j ≤ 1, as many as are asked for, each with its bound.
template <typename Real>
class BoundedJet {
public:
    static constexpr int most_x = 3;
    static constexpr int most_t = 1;

    BoundedJet() = default;
    explicit BoundedJet(const Bounded<Real>& constant) { at(0, 0) = constant; }

    /// x at a point, its derivatives of so many orders followed; t likewise.
    static BoundedJet x(const Real& value, int orders) {
        BoundedJet jet(Bounded<Real>{value, 0});
        jet.x_orders = orders;
        if (orders > 0)
            jet.at(1, 0).value = 1;
        return jet;
    }
    static BoundedJet t(const Real& value, int orders) {
        BoundedJet jet(Bounded<Real>{value, 0});
        jet.t_orders = orders;
        if (orders > 0)
            jet.at(0, 1).value = 1;
        return jet;
    }

    [[nodiscard]] Bounded<Real>& at(int i, int j) { return coefficients_[index(i, j)]; }
    [[nodiscard]] const Bounded<Real>& at(int i, int j) const { return coefficients_[index(i, j)]; }

    /// ∂_x^i ∂_t^j
    [[nodiscard]] Bounded<Real> derivative(int i, int j) const {
        constexpr std::array<int, most_x + 1> factorial = {1, 1, 2, 6};
        const Real factor = factorial[static_cast<std::size_t>(i)];
        return {factor * at(i, j).value, factor * at(i, j).bound};
    }

    // Beyond these orders all coefficients are zero: 0 where the function does not depend on x, t.
    int x_orders = 0;
    int t_orders = 0;

private:
    static std::size_t index(int i, int j) {
        return static_cast<std::size_t>(i) * times + static_cast<std::size_t>(j);
    }
    static constexpr std::size_t times = most_t + 1;
    std::array<Bounded<Real>, times*(most_x + 1)> coefficients_{};
};

template <typename Real>
BoundedJet<Real> operator-(BoundedJet<Real> a) {
    for (int i = 0; i <= a.x_orders; ++i)
        for (int j = 0; j <= a.t_orders; ++j)
            a.at(i, j) = -a.at(i, j);
    return a;
}

template <typename Real>
BoundedJet<Real> operator+(const BoundedJet<Real>& a, const BoundedJet<Real>& b) {
    BoundedJet<Real> sum;
    sum.x_orders = std::max(a.x_orders, b.x_orders);
    sum.t_orders = std::max(a.t_orders, b.t_orders);
    for (int i = 0; i <= sum.x_orders; ++i)
        for (int j = 0; j <= sum.t_orders; ++j)
            sum.at(i, j) = a.at(i, j) + b.at(i, j);
    return sum;
}

/// The rule of Leibniz.
template <typename Real>
BoundedJet<Real> operator*(const BoundedJet<Real>& a, const BoundedJet<Real>& b) {
    BoundedJet<Real> product;
    product.x_orders = std::max(a.x_orders, b.x_orders);
    product.t_orders = std::max(a.t_orders, b.t_orders);
    for (int i = 0; i <= product.x_orders; ++i)
        for (int j = 0; j <= product.t_orders; ++j)
            for (int k = std::max(0, i - b.x_orders); k <= std::min(i, a.x_orders); ++k)
                for (int l = std::max(0, j - b.t_orders); l <= std::min(j, a.t_orders); ++l) {
                    const Bounded<Real> term = a.at(k, l) * b.at(i - k, j - l);
                    product.at(i, j).value += term.value;
                    product.at(i, j).bound += term.bound;
                }
    return product;
}

} // namespace tvbeam
