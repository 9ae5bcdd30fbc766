#include "mms/expression/algebra.hpp"

#include "mms/expression/squares.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <new>
#include <string_view>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr int largest_exponent = 1000;
constexpr int largest_bits = 8192;
constexpr std::size_t largest_derivative = 20'000;
constexpr double largest_expansion = 500;

int bits_of(const numeric& value) {
    if (!value.is_rational())
        return 64;
    return std::max(value.numer().int_length(), value.denom().int_length());
}

/// The largest number of bits of any integer in the expression.
int bits_within(const ex& expression) {
    if (is_a<numeric>(expression))
        return bits_of(ex_to<numeric>(expression));
    int bits = 0;
    for (const ex& operand : expression)
        bits = std::max(bits, bits_within(operand));
    return bits;
}

bool is_real_throughout(const ex& expression) {
    if (is_a<numeric>(expression))
        return ex_to<numeric>(expression).is_real();
    for (const ex& operand : expression)
        if (!is_real_throughout(operand))
            return false;
    return true;
}

std::size_t add_nodes(const ex& expression, std::size_t count, std::size_t limit) {
    ++count;
    for (const ex& operand : expression) {
        if (count > limit)
            break;
        count = add_nodes(operand, count, limit);
    }
    return count;
}

/// Runs an operation of GiNaC; its complaints become `complaint`.
template <typename Operation>
ex guarded(const Operation& operation, const std::string& complaint) {
    ex result;
    try {
        result = operation();
    } catch (const AlgebraError&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw; // the machine's fault, not the expression's
    } catch (const std::exception&) {
        throw AlgebraError(complaint);
    }
    return result;
}

/// About how many terms expanding makes; infinite when out of the question.
double expanded_size(const ex& expression) {
    double size = 1;
    if (is_a<GiNaC::add>(expression)) {
        size = 0;
        for (const ex& term : expression)
            size += expanded_size(term);
    } else if (is_a<GiNaC::mul>(expression)) {
        for (const ex& factor : expression)
            size *= expanded_size(factor);
    } else if (is_a<GiNaC::power>(expression)) {
        const double base = expanded_size(expression.op(0));
        const ex& exponent = expression.op(1);
        // Of a fractional power too, the integer part is multiplied out; of any other, the base.
        if (is_a<numeric>(exponent) && exponent.info(GiNaC::info_flags::positive) && base > 1)
            size = std::pow(base, ex_to<numeric>(exponent).to_double());
        else if (base > largest_expansion)
            size = base;
    }
    return size;
}

ex function_value(const std::string& name, const ex& argument) {
    using Function = ex (*)(const ex&);
    static const std::map<std::string, Function> functions = {
        {"sin", [](const ex& a) -> ex { return GiNaC::sin(a); }},
        {"cos", [](const ex& a) -> ex { return GiNaC::cos(a); }},
        {"tan", [](const ex& a) -> ex { return GiNaC::tan(a); }},
        {"asin", [](const ex& a) -> ex { return GiNaC::asin(a); }},
        {"acos", [](const ex& a) -> ex { return GiNaC::acos(a); }},
        {"atan", [](const ex& a) -> ex { return GiNaC::atan(a); }},
        {"sinh", [](const ex& a) -> ex { return GiNaC::sinh(a); }},
        {"cosh", [](const ex& a) -> ex { return GiNaC::cosh(a); }},
        {"tanh", [](const ex& a) -> ex { return GiNaC::tanh(a); }},
        {"exp", [](const ex& a) -> ex { return GiNaC::exp(a); }},
        {"log", [](const ex& a) -> ex { return GiNaC::log(a); }},
        {"sqrt", [](const ex& a) -> ex { return checked_power(a, numeric(1, 2)); }},
        // not for users: of the law of penalised stops
        {"step", [](const ex& a) -> ex { return GiNaC::step(a); }},
    };
    return functions.at(name)(argument);
}

/// A product with x^(a + t)/x as x^(a - 1 + t): GiNaC joins powers of one base where both exponents
/// are numbers. All of them are joined, so that nothing hangs on the order of the factors.
ex product_by_bases(const ex& product) {
    if (!is_a<GiNaC::mul>(product))
        return product;
    std::map<ex, ex, GiNaC::ex_is_less> exponents;
    ex result = 1;
    bool joined = false;
    bool varies = false;
    for (const ex& factor : product) {
        const bool is_power = is_a<GiNaC::power>(factor);
        const ex base = is_power ? factor.op(0) : factor;
        const ex exponent = is_power ? factor.op(1) : ex(1);
        varies = varies || !is_a<numeric>(exponent);
        if (is_a<numeric>(base)) {
            result *= factor;
            continue;
        }
        const auto [known, is_new] = exponents.try_emplace(base, exponent);
        if (!is_new)
            known->second = (known->second + exponent).expand();
        joined = joined || !is_new;
    }
    if (!joined || !varies)
        return product;
    for (const auto& [base, exponent] : exponents)
        result *= pow(base, exponent);
    return result;
}

/// The derivative. GiNaC's own of b^a is b^a (a' log b + a b'/b), which has no value at b = 0; this
/// one is a b^(a-1) b' + b^a log b a'.
ex differentiated(const ex& expression, const GiNaC::symbol& s) {
    if (!expression.has(s))
        return 0;
    ex result = 0;
    if (is_a<GiNaC::add>(expression)) {
        for (const ex& term : expression)
            result += differentiated(term, s);
    } else if (is_a<GiNaC::mul>(expression)) {
        for (std::size_t i = 0; i < expression.nops(); ++i) {
            const ex changed = differentiated(expression.op(i), s);
            if (changed.is_zero())
                continue;
            GiNaC::exvector factors(expression.begin(), expression.end());
            factors[i] = changed;
            result += with_joined_squares(product_by_bases(GiNaC::mul(factors)));
        }
    } else if (is_a<GiNaC::power>(expression)) {
        const ex base = expression.op(0);
        const ex exponent = expression.op(1);
        result = exponent * pow(base, exponent - 1) * differentiated(base, s);
        if (exponent.has(s))
            result += expression * log(base) * differentiated(exponent, s);
    } else if (is_a<GiNaC::function>(expression)) {
        const GiNaC::realsymbol argument;
        const ex outer = function_value(ex_to<GiNaC::function>(expression).get_name(), argument);
        result = outer.diff(argument).subs(argument == expression.op(0)) *
                 differentiated(expression.op(0), s);
    } else {
        result = expression.diff(s);
    }
    return result;
}

} // namespace

const std::vector<std::string>& function_names() {
    static const std::vector<std::string> names = {"sin",  "cos",  "tan",  "asin", "acos", "atan",
                                                   "sinh", "cosh", "tanh", "exp",  "log",  "sqrt"};
    return names;
}

ex checked_sum(const ex& a, const ex& b) {
    return guarded([&] { return a + b; }, "the sum cannot be evaluated");
}

ex checked_difference(const ex& a, const ex& b) {
    return guarded([&] { return a - b; }, "the difference cannot be evaluated");
}

ex checked_product(const ex& a, const ex& b) {
    return guarded([&] { return a * b; }, "the product cannot be evaluated");
}

ex checked_quotient(const ex& a, const ex& b) {
    if (is_identically_zero(b))
        throw AlgebraError("division by zero");
    return checked_product(a, checked_power(b, -1));
}

ex checked_power(const ex& base, const ex& exponent) {
    if (is_a<numeric>(exponent)) {
        const auto& number = ex_to<numeric>(exponent);
        if (!number.is_rational())
            throw AlgebraError("the exponent is not a real number");
        if (GiNaC::abs(number) > largest_exponent)
            throw AlgebraError("a constant exponent must be at most " +
                               std::to_string(largest_exponent) + " in size");
        if (base.is_zero() && number.is_negative())
            throw AlgebraError("division by zero: 0 has no negative power");
        if (base.is_zero() && number.is_zero())
            throw AlgebraError("0^0 has no value");
        if (is_a<numeric>(base) && ex_to<numeric>(base).is_negative() && !number.is_integer())
            throw AlgebraError("a negative number has no real fractional power");
        if (bits_within(base) * GiNaC::abs(number).to_double() > largest_bits)
            throw AlgebraError("this power of a constant is too large to be computed exactly");
    }
    ex result = guarded([&] { return GiNaC::pow(base, exponent); }, "the power has no value");
    if (!is_real_throughout(result))
        throw AlgebraError("the power of a negative number is not real");
    return result;
}

ex checked_function(const std::string& name, const ex& argument) {
    if ((name == "asin" || name == "acos") && is_a<numeric>(argument) &&
        GiNaC::abs(ex_to<numeric>(argument)) > 1)
        throw AlgebraError(name + " has no real value beyond -1 and 1");
    ex result =
        guarded([&] { return function_value(name, argument); }, name + " has no value there");
    if (!is_real_throughout(result))
        throw AlgebraError(name + " is not a real number there");
    return result;
}

ex substituted(const ex& expression, const GiNaC::exmap& values) {
    if (is_a<GiNaC::symbol>(expression)) {
        const auto found = values.find(expression);
        return found == values.end() ? expression : found->second;
    }
    if (is_a<GiNaC::power>(expression))
        return checked_power(substituted(expression.op(0), values),
                             substituted(expression.op(1), values));
    if (is_a<GiNaC::function>(expression))
        return checked_function(ex_to<GiNaC::function>(expression).get_name(),
                                substituted(expression.op(0), values));
    if (is_a<GiNaC::add>(expression) || is_a<GiNaC::mul>(expression)) {
        GiNaC::exvector operands;
        operands.reserve(expression.nops());
        for (const ex& operand : expression)
            operands.push_back(substituted(operand, values));
        const bool sum = is_a<GiNaC::add>(expression);
        return guarded([&] { return sum ? ex(GiNaC::add(operands)) : ex(GiNaC::mul(operands)); },
                       "the expression cannot be evaluated");
    }
    return expression;
}

std::optional<numeric> number_with(const ex& expression, const GiNaC::exmap& values) {
    try {
        const ex value = substituted(expression, values);
        return is_a<numeric>(value) ? std::optional(ex_to<numeric>(value)) : std::nullopt;
    } catch (const AlgebraError&) {
        return std::nullopt;
    }
}

ex derivative(const ex& expression, const GiNaC::symbol& s) {
    ex result =
        guarded([&] { return differentiated(expression, s); }, "the derivative has no value");
    if (add_nodes(result, 0, largest_derivative) > largest_derivative)
        throw AlgebraError("the derivatives are too large; write it with fewer factors or "
                           "less deeply nested functions");
    return result;
}

namespace {

/// Puts symbols in the place of roots.
struct RootsHidden final : GiNaC::map_function {
    GiNaC::exmap symbols, roots;

    ex operator()(const ex& part) override {
        const bool is_root = is_a<GiNaC::power>(part) && !is_a<GiNaC::symbol>(part.op(0)) &&
                             !part.op(1).info(GiNaC::info_flags::integer);
        if (!is_root)
            return part.nops() == 0 ? part : part.map(*this);
        auto known = symbols.find(part);
        if (known == symbols.end()) {
            known = symbols.emplace(part, GiNaC::realsymbol()).first;
            roots.emplace(known->second, GiNaC::pow(expanded(part.op(0)), part.op(1)));
        }
        return known->second;
    }
};

} // namespace

ex expanded(const ex& expression) {
    RootsHidden hidden;
    ex without = hidden(expression).expand();
    if (hidden.roots.empty())
        return without;
    return without.subs(hidden.roots, GiNaC::subs_options::no_pattern);
}

ex moderately_expanded(const ex& expression) {
    // Written so that an infinite or undefined estimate counts as too large.
    if (!(expanded_size(expression) <= largest_expansion))
        return expression;
    try {
        return guarded([&] { return expanded(expression); }, "the expression cannot be expanded");
    } catch (const AlgebraError&) { // x^(-1e18*(t - 1/3)^2) has powers of x beyond GiNaC's
        return expression;
    }
}

bool is_identically_zero(const ex& expression) {
    if (expression.is_zero())
        return true;
    if (!is_a<GiNaC::add>(expression) && !is_a<GiNaC::mul>(expression))
        return false;
    return moderately_expanded(expression).is_zero();
}

numeric exact_rational(double value) {
    // The longest shortest form has 17 digits, a point, a sign and an exponent of three digits with
    // its own.
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::scientific);
    const std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    const std::size_t e = text.find('e');
    std::string digits;
    int decimals = 0;
    bool after_point = false;
    for (const char character : text.substr(0, e)) {
        if (character == '.') {
            after_point = true;
        } else {
            digits += character;
            decimals += after_point ? 1 : 0;
        }
    }
    const int exponent = std::atoi(std::string(text.substr(e + 1)).c_str()) - decimals;
    return numeric(digits.c_str()) * GiNaC::pow(numeric(10), numeric(exponent));
}

bool may_jump(const ex& expression) {
    const auto is_suspect = [](const ex& part) {
        if (is_a<GiNaC::power>(part))
            return !part.op(1).info(GiNaC::info_flags::nonnegint);
        if (!is_a<GiNaC::function>(part))
            return false;
        const std::string name = ex_to<GiNaC::function>(part).get_name();
        return name == "tan" || name == "asin" || name == "acos" || name == "log";
    };
    // Of a number, as sqrt(2) and 2^x, it does not.
    const auto is_constant = [](const ex& part) { return is_a<numeric>(part.evalf()); };
    for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
        if (is_suspect(*part) && !is_constant(part->op(0)))
            return true;
    return false;
}

bool depends_on(const ex& expression, const GiNaC::symbol& s) {
    return expression.has(s);
}

} // namespace tvbeam
