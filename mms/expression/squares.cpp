#include "mms/expression/squares.hpp"

#include "mms/expression/symbols.hpp"

#include <optional>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

/// (root²)^exponent.
struct SquarePower {
    ex root;
    numeric exponent;
};

/// A factor as a negative power of a square.
std::optional<SquarePower> divisor_in(const ex& factor) {
    if (!is_a<GiNaC::power>(factor) || !is_a<GiNaC::power>(factor.op(0)))
        return std::nullopt;
    const ex& exponent = factor.op(1);
    const ex& inner = factor.op(0).op(1);
    if (!exponent.info(GiNaC::info_flags::rational) || exponent.info(GiNaC::info_flags::positive) ||
        !inner.info(GiNaC::info_flags::posint) || !inner.info(GiNaC::info_flags::even))
        return std::nullopt;
    return SquarePower{factor.op(0).op(0), ex_to<numeric>(exponent) * ex_to<numeric>(inner) / 2};
}

/// c with a = c b, if there is one: GiNaC has x - 3/10 for a factor, but 10 x - 3 or 3 - 10 x for
/// the base of a power.
std::optional<numeric> ratio(const ex& a, const ex& b) {
    const numeric of_a = a.integer_content();
    const numeric of_b = b.integer_content();
    if (of_a.is_zero() || of_b.is_zero())
        return std::nullopt;
    const ex primitive_a = a / of_a;
    const ex primitive_b = b / of_b;
    if (primitive_a.is_equal(primitive_b))
        return of_a / of_b;
    if ((primitive_a + primitive_b).is_zero())
        return -of_a / of_b;
    return std::nullopt;
}

/// Joins one factor g^n to one divisor; what is left of the factor remains in it.
void join(ex& factor, SquarePower& divisor, ex& result, bool with_sign) {
    const bool is_power = is_a<GiNaC::power>(factor);
    const ex base = is_power ? factor.op(0) : factor;
    const ex exponent = is_power ? factor.op(1) : ex(1);
    if (!exponent.info(GiNaC::info_flags::posint))
        return;
    const auto c = ratio(base, divisor.root);
    if (!c)
        return;
    const auto& n = ex_to<numeric>(exponent);
    const numeric odd = n.is_odd() ? 1 : 0;
    result *= pow(*c, n - odd);
    divisor.exponent += (n - odd) / 2;
    factor = pow(base, odd);
    const bool jumps = with_sign && n.is_odd() && divisor.exponent.is_negative() &&
                       divisor.exponent * 2 >= -1 && divisor.root.has(model_symbols().x);
    if (!jumps)
        return;
    divisor.exponent += numeric(1, 2);
    factor = *c * (2 * step(divisor.root) - 1);
}

ex joined(const ex& product, bool with_sign) {
    if (!is_a<GiNaC::mul>(product))
        return product;
    GiNaC::exvector factors(product.begin(), product.end());
    ex result = 1;
    bool same = true;
    for (ex& below : factors) {
        auto divisor = divisor_in(below);
        if (!divisor)
            continue;
        const numeric before = divisor->exponent;
        for (ex& above : factors)
            join(above, *divisor, result, with_sign);
        if (divisor->exponent == before)
            continue;
        below = pow(pow(divisor->root, 2), divisor->exponent);
        same = false;
    }
    if (same)
        return product;
    for (const ex& factor : factors)
        result *= factor;
    return result;
}

} // namespace

ex with_joined_squares(const ex& product) {
    return joined(product, false);
}

ex with_signs(const ex& product) {
    return joined(product, true);
}

} // namespace tvbeam
