#include "tests/fuzz/targets.hpp"

#include "mms/expression/agreement.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/expression/tape_compiler.hpp"
#include "mms/text/input_error.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace tvbeam::fuzz {

namespace {

using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                             boost::multiprecision::et_off>;

constexpr std::size_t points = 4;
constexpr std::array<double, points> xs = {0.0625, 0.37109375, 0.7548828125, 0.9375};
constexpr std::array<double, points> ts = {0.5703125, 1.140625, 0.0859375, 1.703125};

/// A text and what it is worth at each point.
struct Chosen {
    std::string text;
    std::array<Digits, points> values;
};

/// Chooses by the bytes, one after the other; where they end, the first of each choice.
class Chooser {
public:
    explicit Chooser(std::span<const std::uint8_t> data) : data_(data) {}

    /// Whether an exponential at point k was below doubles: the library may take it for zero,
    /// whatever becomes of it, and says so.
    bool exponential_underflows(std::size_t k) const { return underflows_[k]; }

    Chosen expression(int depth = 0) {
        constexpr int deepest = 6;
        if (depth == deepest)
            return leaf();
        switch (pick(10)) {
        case 0:
        case 1:
            return leaf();
        case 2:
            return joined(expression(depth + 1), "+", expression(depth + 1),
                          [](const Digits& a, const Digits& b) { return Digits(a + b); });
        case 3:
            return joined(expression(depth + 1), "-", expression(depth + 1),
                          [](const Digits& a, const Digits& b) { return Digits(a - b); });
        case 4:
            return joined(expression(depth + 1), "*", expression(depth + 1),
                          [](const Digits& a, const Digits& b) { return Digits(a * b); });
        case 5:
            return joined(expression(depth + 1), "/", expression(depth + 1),
                          [](const Digits& a, const Digits& b) { return Digits(a / b); });
        case 6:
            return power(expression(depth + 1));
        case 7:
            return of_one(expression(depth + 1), "-", [](const Digits& a) { return Digits(-a); });
        default:
            return function(expression(depth + 1));
        }
    }

private:
    unsigned pick(unsigned count) {
        if (data_.empty())
            return 0;
        const unsigned chosen = data_.front() % count;
        data_ = data_.subspan(1);
        return chosen;
    }

    Chosen leaf() {
        Chosen chosen;
        const unsigned kind = pick(4);
        const std::string number = kind == 3 ? decimal() : "";
        for (std::size_t k = 0; k < points; ++k)
            chosen.values[k] = kind == 0   ? Digits(xs[k])
                               : kind == 1 ? Digits(ts[k])
                               : kind == 2 ? boost::math::constants::pi<Digits>()
                                           : Digits(number);
        chosen.text = kind == 0 ? "x" : kind == 1 ? "t" : kind == 2 ? "pi" : number;
        return chosen;
    }

    std::string decimal() {
        static const std::array<const char*, 8> forms = {"",    "0.", "0.00", "1.",
                                                         "12.", "1e", "3e-",  "100"};
        return forms[pick(forms.size())] + std::to_string(1 + pick(20));
    }

    /// What binds less than the operation stands in brackets, by how the text was made.
    template <typename Operation>
    static Chosen joined(const Chosen& a, const std::string& sign, const Chosen& b,
                         const Operation& operation) {
        Chosen result{"(" + a.text + ")" + sign + "(" + b.text + ")", {}};
        for (std::size_t k = 0; k < points; ++k)
            result.values[k] = operation(a.values[k], b.values[k]);
        return result;
    }

    template <typename Operation>
    static Chosen of_one(const Chosen& a, const std::string& name, const Operation& operation) {
        Chosen result{name + "(" + a.text + ")", {}};
        for (std::size_t k = 0; k < points; ++k)
            result.values[k] = operation(a.values[k]);
        return result;
    }

    /// -a^n is -(a^n), and a^b^c is a^(b^c): without brackets.
    Chosen power(const Chosen& a) {
        const int exponent = 1 + static_cast<int>(pick(12));
        const bool negative = pick(3) == 0;
        Chosen result{"-(" + a.text + ")^" + (negative ? "(-" : "") + std::to_string(exponent) +
                          (negative ? ")" : "") + "^1",
                      {}};
        for (std::size_t k = 0; k < points; ++k) {
            Digits product = 1;
            for (int n = 0; n < exponent; ++n)
                product *= a.values[k];
            result.values[k] = negative ? Digits(-1 / product) : Digits(-product);
        }
        return result;
    }

    Chosen function(const Chosen& a) {
        using Function = Digits (*)(const Digits&);
        static const std::array<std::pair<const char*, Function>, 12> functions = {
            {{"sin", [](const Digits& v) { return Digits(sin(v)); }},
             {"cos", [](const Digits& v) { return Digits(cos(v)); }},
             {"tan", [](const Digits& v) { return Digits(tan(v)); }},
             {"asin", [](const Digits& v) { return Digits(asin(v)); }},
             {"acos", [](const Digits& v) { return Digits(acos(v)); }},
             {"atan", [](const Digits& v) { return Digits(atan(v)); }},
             {"sinh", [](const Digits& v) { return Digits(sinh(v)); }},
             {"cosh", [](const Digits& v) { return Digits(cosh(v)); }},
             {"tanh", [](const Digits& v) { return Digits(tanh(v)); }},
             {"exp", [](const Digits& v) { return Digits(exp(v)); }},
             {"log", [](const Digits& v) { return Digits(log(v)); }},
             {"sqrt", [](const Digits& v) { return Digits(sqrt(v)); }}}};
        const auto& chosen = functions[pick(functions.size())];
        for (std::size_t k = 0; chosen.first == std::string("exp") && k < points; ++k)
            underflows_[k] = underflows_[k] || a.values[k] < -708;
        return of_one(a, chosen.first, [&](const Digits& v) {
            // Of larger arguments 60 digits are too few, or take too long.
            return abs(v) < Digits(1e4) ? chosen.second(v)
                                        : Digits(std::numeric_limits<double>::quiet_NaN());
        });
    }

    std::span<const std::uint8_t> data_;
    std::array<bool, points> underflows_{};
};

template <typename Real>
Bounded<Real> at(const PlainExpression& plain, std::size_t k, const Real& pi) {
    return evaluated<Real>(plain, {{"x", BoundedJet<Real>::x(Real(xs[k]), 0)},
                                   {"t", BoundedJet<Real>::t(Real(ts[k]), 0)},
                                   {"pi", BoundedJet<Real>(Bounded<Real>{pi, pi})}})
        .derivative(0, 0);
}

} // namespace

bool grammar(std::span<const std::uint8_t> data) {
    Chooser chooser(data);
    const Chosen chosen = chooser.expression();
    PlainExpression plain;
    GiNaC::ex formula;
    try {
        formula =
            parse_expression(SourceText(chosen.text, {"fuzz", 1, 1}), model_symbol_table(), &plain);
        const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(xs.data(), points);
        const Eigen::ArrayXd t = Eigen::Map<const Eigen::ArrayXd>(ts.data(), points);
        const ComputedValues computed =
            ComputedValues::of(compile_tape({formula}).evaluate(x, t).row(0));
        std::vector<Bounded<long double>> written_values;
        for (std::size_t k = 0; k < points; ++k)
            written_values.push_back(at(plain, k, std::numbers::pi_v<long double>));
        if (first_disagreement(written_values, computed))
            return false;
        std::array<Digits, points> bounds;
        Digits largest = 0;
        for (std::size_t k = 0; k < points; ++k) {
            bounds[k] = at(plain, k, boost::math::constants::pi<Digits>()).bound;
            if (isfinite(bounds[k]))
                largest = std::max(largest, bounds[k]);
        }
        for (std::size_t k = 0; k < points; ++k) {
            const Digits& terms = bounds[k];
            const double value = computed.values(static_cast<Eigen::Index>(k));
            const Digits& expected = chosen.values[k];
            // What is beyond doubles is refused where it is used.
            if (!isfinite(expected) || !isfinite(terms) || !std::isfinite(value))
                continue;
            // What becomes of an exponential that underflows, if it is all that there is.
            if (chooser.exponential_underflows(k) && abs(expected) < 1e-100)
                continue;
            // Where a part overflows or an exponential underflows, a value that is nothing beside
            // those at other points is lost, as the library says.
            const bool leaves_range = chooser.exponential_underflows(k) ||
                                      !std::isfinite(at(plain, k, std::numbers::pi).bound);
            const Digits lost = leaves_range ? Digits(1e-25 * largest) : Digits(0);
            const Digits off = abs(value - expected);
            const bool near = off <= 1e-12 * terms + lost + 1e-290;
            // At a zero of high order the terms say nothing, and what is left is what the rounding
            // of pi moves the value by: tan(16 pi)^12.
            require(near || off <= 4 * abs(at(plain, k, Digits(std::numbers::pi)).value - expected),
                    chosen.text + " is " + Digits(value).str(20) + ", not " + expected.str(20));
        }
        return true;
    } catch (const InputError&) {
        return false;
    } catch (const AlgebraError&) {
        return false;
    }
}

} // namespace tvbeam::fuzz
