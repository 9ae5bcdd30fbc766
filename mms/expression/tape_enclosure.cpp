#include "mms/expression/tape.hpp"

#include <boost/numeric/interval.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

/// Arithmetic in the processor's rounding to nearest, and its results then moved outwards, by more
/// than they can be wrong: half a unit in the last place, and what glibc's manual states for its
/// functions, at most 3. The rounding mode stays, as its functions want.
template <typename Real>
struct Outward {
    static constexpr Real unit = std::numeric_limits<Real>::epsilon();
    static constexpr Real tiny = std::numeric_limits<Real>::min();
    static constexpr Real largest = std::numeric_limits<Real>::max();
    static constexpr Real of_functions = 4 * unit;

    static Real lowered(Real value, Real relative) {
        if (value > largest)
            return largest;
        const Real below = value - (std::abs(value) * relative + tiny);
        return value > 0 ? std::max(below, Real(0)) : below;
    }
    static Real raised(Real value, Real relative) { return -lowered(-value, relative); }

    void init() {}
    template <typename Other>
    Real conv_down(const Other& value) {
        return value;
    }
    template <typename Other>
    Real conv_up(const Other& value) {
        return value;
    }
    // A sum that is zero or below the normal numbers is exact.
    Real add_down(Real a, Real b) {
        const Real sum = a + b;
        return sum > largest ? largest : sum - std::abs(sum) * unit;
    }
    Real add_up(Real a, Real b) { return -add_down(-a, -b); }
    Real sub_down(Real a, Real b) { return add_down(a, -b); }
    Real sub_up(Real a, Real b) { return add_up(a, -b); }
    // A product is zero because a factor is, or because it is too small.
    Real mul_down(Real a, Real b) {
        if (a == 0 || b == 0)
            return 0;
        const bool positive = (a > 0) == (b > 0);
        return positive ? std::max(lowered(a * b, unit), Real(0)) : lowered(a * b, unit);
    }
    Real mul_up(Real a, Real b) { return -mul_down(-a, b); }
    Real div_down(Real a, Real b) {
        if (a == 0)
            return 0;
        const bool positive = (a > 0) == (b > 0);
        return positive ? std::max(lowered(a / b, unit), Real(0)) : lowered(a / b, unit);
    }
    Real div_up(Real a, Real b) { return -div_down(-a, b); }
    Real median(Real a, Real b) { return a / 2 + b / 2; }
    Real sqrt_down(Real a) { return lowered(std::sqrt(a), unit); }
    Real sqrt_up(Real a) { return a == 0 ? Real(0) : raised(std::sqrt(a), unit); }
    Real int_down(Real a) { return std::floor(a); }
    Real int_up(Real a) { return std::ceil(a); }

    Real exp_down(Real a) { return std::max(lowered(std::exp(a), of_functions), Real(0)); }
    Real exp_up(Real a) { return raised(std::exp(a), of_functions); }
    Real log_down(Real a) { return lowered(std::log(a), of_functions); }
    Real log_up(Real a) { return raised(std::log(a), of_functions); }
    Real cos_down(Real a) { return std::max(lowered(std::cos(a), of_functions), Real(-1)); }
    Real cos_up(Real a) { return std::min(raised(std::cos(a), of_functions), Real(1)); }
    Real tan_down(Real a) { return lowered(std::tan(a), of_functions); }
    Real tan_up(Real a) { return raised(std::tan(a), of_functions); }
    Real asin_down(Real a) { return lowered(std::asin(a), of_functions); }
    Real asin_up(Real a) { return raised(std::asin(a), of_functions); }
    Real acos_down(Real a) { return std::max(lowered(std::acos(a), of_functions), Real(0)); }
    Real acos_up(Real a) { return raised(std::acos(a), of_functions); }
    Real atan_down(Real a) { return lowered(std::atan(a), of_functions); }
    Real atan_up(Real a) { return raised(std::atan(a), of_functions); }
    Real sinh_down(Real a) { return lowered(std::sinh(a), of_functions); }
    Real sinh_up(Real a) { return raised(std::sinh(a), of_functions); }
    Real cosh_down(Real a) { return std::max(lowered(std::cosh(a), of_functions), Real(1)); }
    Real cosh_up(Real a) { return raised(std::cosh(a), of_functions); }
    Real tanh_down(Real a) { return std::max(lowered(std::tanh(a), of_functions), Real(-1)); }
    Real tanh_up(Real a) { return std::min(raised(std::tanh(a), of_functions), Real(1)); }
};

template <typename Real>
using OutwardInterval =
    boost::numeric::interval<Real,
                             boost::numeric::interval_lib::policies<
                                 boost::numeric::interval_lib::save_state_nothing<Outward<Real>>,
                                 boost::numeric::interval_lib::checking_base<Real>>>;

template <typename Real>
bool is_exactly(const OutwardInterval<Real>& a, Real value) {
    return a.lower() == value && a.upper() == value;
}

template <typename Real>
bool holds_zero(const OutwardInterval<Real>& a) {
    return !(a.lower() > 0 || a.upper() < 0);
}

/// Infinity less infinity: nothing is known.
template <typename Real>
OutwardInterval<Real> known(const OutwardInterval<Real>& a) {
    return std::isnan(a.lower()) || std::isnan(a.upper()) ? OutwardInterval<Real>::whole() : a;
}

/// a/b; without bounds where b may be zero.
template <typename Real>
OutwardInterval<Real> quotient(const OutwardInterval<Real>& a, const OutwardInterval<Real>& b) {
    return holds_zero(b) ? OutwardInterval<Real>::whole() : known<Real>(a / b);
}

/// a^b for a ≥ 0: b log a is bilinear, and greatest and least in a corner.
template <typename Real>
OutwardInterval<Real> power(const OutwardInterval<Real>& a, const OutwardInterval<Real>& b) {
    if (!(a.lower() >= 0) || (a.lower() == 0 && !(b.lower() > 0)))
        return OutwardInterval<Real>::whole();
    const std::array<Real, 4> corners = {
        std::pow(a.lower(), b.lower()), std::pow(a.lower(), b.upper()),
        std::pow(a.upper(), b.lower()), std::pow(a.upper(), b.upper())};
    const auto [least, greatest] = std::minmax_element(corners.begin(), corners.end());
    using Rounded = Outward<Real>;
    return known(OutwardInterval<Real>(
        std::max(Rounded::lowered(*least, Rounded::of_functions), Real(0)),
        *greatest == 0 && a.upper() == 0 ? Real(0)
                                         : Rounded::raised(*greatest, Rounded::of_functions)));
}

template <typename Real>
OutwardInterval<Real> logarithm(const OutwardInterval<Real>& a) {
    return a.lower() < 0 || !(a.upper() > 0) ? OutwardInterval<Real>::whole() : log(a);
}

/// a^b log a, whose least value for b > 0 is −1/(e b), at a = exp(−1/b).
template <typename Real>
OutwardInterval<Real> power_logarithm(const OutwardInterval<Real>& a,
                                      const OutwardInterval<Real>& b) {
    if (!(a.lower() == 0) || !(b.lower() > 0))
        return known<Real>(power(a, b) * logarithm(a));
    const OutwardInterval<Real> least =
        -(OutwardInterval<Real>(1) / (exp(OutwardInterval<Real>(1)) * b));
    const OutwardInterval<Real> at_end =
        a.upper() > 0 ? known<Real>(power(OutwardInterval<Real>(a.upper()), b) *
                                    logarithm(OutwardInterval<Real>(a.upper())))
                      : OutwardInterval<Real>(0);
    // Up to its least place it falls from 0.
    const OutwardInterval<Real> place = exp(-(OutwardInterval<Real>(1) / b));
    const bool falls = a.upper() <= place.lower();
    return {falls ? at_end.lower() : std::min(least.lower(), at_end.lower()),
            std::max(at_end.upper(), Real(0))};
}

/// Values and derivatives of one register.
template <typename Real>
struct Enclosed {
    OutwardInterval<Real> value;
    OutwardInterval<Real> slope;
};

} // namespace

/// The operations of a tape on enclosures.
class TapeEnclosure {
public:
    template <typename Real>
    static Enclosed<Real> apply(Tape::Operation operation, const Enclosed<Real>& a,
                                const Enclosed<Real>& b) {
        OutwardInterval<Real> result = value(operation, a.value, b.value);
        OutwardInterval<Real> rate(0);
        if (!is_exactly(a.slope, Real(0)) || !is_exactly(b.slope, Real(0)))
            rate = known(slope(operation, a, b, result));
        return {known(result), rate};
    }

private:
    using Operation = Tape::Operation;

    template <typename Real>
    static OutwardInterval<Real> value(Operation operation, const OutwardInterval<Real>& a,
                                       const OutwardInterval<Real>& b) {
        using I = OutwardInterval<Real>;
        switch (operation) {
        case Operation::Add:
            return a + b;
        case Operation::Subtract:
            return a - b;
        case Operation::Multiply:
            return a * b;
        case Operation::Divide:
            return quotient(a, b);
        case Operation::Power:
            return power(a, b);
        case Operation::PowerLog:
            return power_logarithm(a, b);
        case Operation::Negate:
            return -a;
        case Operation::Reciprocal:
            return quotient(I(1), a);
        case Operation::Square:
            return square(a);
        case Operation::SquareRoot:
            return a.lower() >= 0 ? sqrt(a) : I::whole();
        case Operation::Sin:
            return bounded(a) ? sin(a) : I(-1, 1);
        case Operation::Cos:
            return bounded(a) ? cos(a) : I(-1, 1);
        case Operation::Tan:
            return bounded(a) ? tan(a) : I::whole();
        case Operation::Asin:
            return a.lower() >= -1 && a.upper() <= 1 ? asin(a) : I::whole();
        case Operation::Acos:
            return a.lower() >= -1 && a.upper() <= 1 ? acos(a) : I::whole();
        case Operation::Atan:
            return atan(a);
        case Operation::Sinh:
            return sinh(a);
        case Operation::Cosh:
            return cosh(a);
        case Operation::Tanh:
            return tanh(a);
        case Operation::Exp:
            return exp(a);
        case Operation::Log:
            return logarithm(a);
        case Operation::Step:
            return a.lower() > 0 ? I(1) : a.upper() < 0 ? I(0) : I(0, 1);
        }
        return I::whole();
    }

    template <typename Real>
    static bool bounded(const OutwardInterval<Real>& a) {
        return std::isfinite(a.lower()) && std::isfinite(a.upper());
    }

    /// result: the value.
    template <typename Real>
    static OutwardInterval<Real> slope(Operation operation, const Enclosed<Real>& a,
                                       const Enclosed<Real>& b,
                                       const OutwardInterval<Real>& result) {
        using I = OutwardInterval<Real>;
        const I one(1);
        switch (operation) {
        case Operation::Add:
            return a.slope + b.slope;
        case Operation::Subtract:
            return a.slope - b.slope;
        case Operation::Multiply:
            return a.slope * b.value + a.value * b.slope;
        case Operation::Divide:
            return quotient<Real>(a.slope - result * b.slope, b.value);
        case Operation::Power:
            if (is_exactly(b.slope, Real(0)))
                return b.value * power<Real>(a.value, b.value - one) * a.slope;
            return result * (b.slope * logarithm(a.value) + b.value * quotient(a.slope, a.value));
        case Operation::PowerLog: {
            const I log_a = logarithm(a.value);
            const I rate = quotient(a.slope, a.value);
            return power(a.value, b.value) * ((b.slope * log_a + b.value * rate) * log_a + rate);
        }
        case Operation::Negate:
            return -a.slope;
        case Operation::Reciprocal:
            return -(square(result) * a.slope);
        case Operation::Square:
            return I(2) * a.value * a.slope;
        case Operation::SquareRoot:
            return quotient<Real>(a.slope, I(2) * result);
        case Operation::Sin:
            return value(Operation::Cos, a.value, a.value) * a.slope;
        case Operation::Cos:
            return -(value(Operation::Sin, a.value, a.value) * a.slope);
        case Operation::Tan:
            return (one + square(result)) * a.slope;
        case Operation::Asin:
            return quotient(a.slope, value(Operation::SquareRoot, one - square(a.value), one));
        case Operation::Acos:
            return -quotient(a.slope, value(Operation::SquareRoot, one - square(a.value), one));
        case Operation::Atan:
            return quotient<Real>(a.slope, one + square(a.value));
        case Operation::Sinh:
            return cosh(a.value) * a.slope;
        case Operation::Cosh:
            return sinh(a.value) * a.slope;
        case Operation::Tanh:
            return (one - square(result)) * a.slope;
        case Operation::Exp:
            return result * a.slope;
        case Operation::Log:
            return quotient(a.slope, a.value);
        case Operation::Step:
            return holds_zero(a.value) ? I::whole() : I(0);
        }
        return I::whole();
    }
};

template <typename Real>
Enclosure Tape::enclose_in(Eigen::Index output, double x, double begin, double end) const {
    using I = OutwardInterval<Real>;
    std::vector<Enclosed<Real>> registers(static_cast<std::size_t>(register_count_), {I(0), I(0)});
    const auto at = [&registers](int index) -> Enclosed<Real>& {
        return registers[static_cast<std::size_t>(index)];
    };
    at(0).value = I(x);
    at(1) = {I(begin, end), I(1)};
    for (const Constant& constant : constants_)
        at(constant.target).value = I(static_cast<Real>(constant.value));
    for (const Instruction& one : instructions_)
        at(one.target) =
            TapeEnclosure::apply(one.operation, at(one.left),
                                 one.right < 0 ? Enclosed<Real>{I(0), I(0)} : at(one.right));
    const auto range = [](const I& interval) -> Range {
        // A long double goes into a double.
        return {static_cast<double>(Outward<Real>::lowered(interval.lower(), 0x1p-52L)),
                static_cast<double>(Outward<Real>::raised(interval.upper(), 0x1p-52L))};
    };
    const Enclosed<Real>& result = at(outputs_[static_cast<std::size_t>(output)]);
    if constexpr (std::is_same_v<Real, double>)
        return {{result.value.lower(), result.value.upper()},
                {result.slope.lower(), result.slope.upper()}};
    return {range(result.value), range(result.slope)};
}

Enclosure Tape::enclose(Eigen::Index output, double x, double begin, double end) const {
    return wide_ ? enclose_in<long double>(output, x, begin, end)
                 : enclose_in<double>(output, x, begin, end);
}

} // namespace tvbeam
