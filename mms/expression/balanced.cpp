#include "mms/expression/balanced.hpp"

#include "mms/expression/squares.hpp"

#include <algorithm>
#include <optional>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

bool is_function(const ex& expression, const char* name) {
    return is_a<GiNaC::function>(expression) &&
           ex_to<GiNaC::function>(expression).get_name() == name;
}

/// A factor as base and integer exponent.
struct Power {
    ex base;
    int exponent = 1;
};

Power power_of(const ex& factor) {
    if (is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::integer))
        return {factor.op(0), ex_to<numeric>(factor.op(1)).to_int()};
    return {factor};
}

/// The argument of the only exponential in a sum, if it stands in one term, as a factor.
std::optional<ex> exponent_in(const ex& sum) {
    std::optional<ex> found;
    for (const ex& term : sum) {
        const GiNaC::exvector factors = is_a<GiNaC::mul>(term)
                                            ? GiNaC::exvector(term.begin(), term.end())
                                            : GiNaC::exvector{term};
        for (const ex& factor : factors) {
            if (!is_function(factor, "exp"))
                continue;
            if (found)
                return std::nullopt;
            found = factor.op(0);
        }
    }
    return found;
}

/// n with a = n z, for 1 ≤ n ≤ 10; 0 if there is none.
int multiple(const ex& a, const ex& z) {
    for (int n = 1; n <= 10; ++n)
        if ((a - n * z).is_zero())
            return n;
    return 0;
}

/// sum·e^-z, for the only exponential e^z in it.
ex divided(const ex& sum, const ex& z) {
    ex result = 0;
    for (const ex& term : sum)
        result += term.has(exp(z)) ? ex(term / exp(z)) : ex(term * exp(-z));
    return result;
}

/// e^(m z)/S^n with S = g + h e^z becomes e^((m-p) z)/((g e^-z + h)^p S^(n-p)), p = min(m, n).
void balance_exponentials(GiNaC::exvector& factors) {
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const Power divisor = power_of(factors[i]);
        if (divisor.exponent >= 0 || !is_a<GiNaC::add>(divisor.base))
            continue;
        const auto z = exponent_in(divisor.base);
        if (!z)
            continue;
        int m = 0;
        for (ex& factor : factors) {
            const int n = is_function(factor, "exp") ? multiple(factor.op(0), *z) : 0;
            m += n;
            if (n > 0)
                factor = 1;
        }
        const int p = std::min(m, -divisor.exponent);
        factors[i] = pow(divisor.base, divisor.exponent + p) * pow(divided(divisor.base, *z), -p) *
                     exp((m - p) * *z);
    }
}

/// sinh(z)^m/cosh(z)^n becomes tanh(z)^p sinh(z)^(m-p)/cosh(z)^(n-p), p = min(m, n).
void balance_hyperbolic(GiNaC::exvector& factors) {
    for (ex& below : factors) {
        const Power divisor = power_of(below);
        if (divisor.exponent >= 0 || !is_function(divisor.base, "cosh"))
            continue;
        const ex z = divisor.base.op(0);
        for (ex& above : factors) {
            const Power factor = power_of(above);
            if (factor.exponent <= 0 || !is_function(factor.base, "sinh") ||
                !factor.base.op(0).is_equal(z))
                continue;
            const int p = std::min(factor.exponent, -divisor.exponent);
            above = pow(factor.base, factor.exponent - p) * pow(tanh(z), p);
            below = pow(divisor.base, divisor.exponent + p);
            break;
        }
    }
}

} // namespace

ex balanced(const ex& expression) {
    if (expression.nops() == 0)
        return expression;
    GiNaC::exvector operands;
    operands.reserve(expression.nops());
    bool same = true;
    for (const ex& operand : expression) {
        operands.push_back(balanced(operand));
        same = same && GiNaC::are_ex_trivially_equal(operands.back(), operand);
    }
    if (!is_a<GiNaC::mul>(expression))
        return same ? expression
                    : expression.map([](const ex& operand) { return balanced(operand); });
    const GiNaC::exvector before = operands;
    balance_exponentials(operands);
    balance_hyperbolic(operands);
    for (std::size_t i = 0; i < operands.size(); ++i)
        same = same && operands[i].is_equal(before[i]);
    return with_signs(same ? expression : ex(GiNaC::mul(operands)));
}

} // namespace tvbeam
