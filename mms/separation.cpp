#include "mms/separation.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/canonical.hpp"
#include "mms/expression/symbols.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr std::size_t most_products = 32;
constexpr int largest_distributed_power = 8;

using Products = std::vector<SeparatedProduct>;

/// Too many products: the whole is not worth separating.
struct TooManyProducts {};

bool has_x(const ex& expression) {
    return depends_on(expression, model_symbols().x);
}
bool has_t(const ex& expression) {
    return depends_on(expression, model_symbols().t);
}
bool is_mixed(const ex& expression) {
    return has_x(expression) && has_t(expression);
}

void append(Products& products, const Products& more) {
    if (products.size() + more.size() > most_products)
        throw TooManyProducts{};
    products.insert(products.end(), more.begin(), more.end());
}

/// Adds a product to those there are; to the amplitude if the profile is there.
void add_product(Products& products, const SeparatedProduct& product) {
    const auto same =
        std::find_if(products.begin(), products.end(), [&product](const SeparatedProduct& known) {
            return known.profile.is_equal(product.profile);
        });
    if (same == products.end())
        append(products, {product});
    else
        same->amplitude += product.amplitude;
}

Products multiplied(const Products& a, const Products& b) {
    Products result;
    for (const SeparatedProduct& left : a)
        for (const SeparatedProduct& right : b)
            add_product(result, {left.amplitude * right.amplitude, left.profile * right.profile});
    return result;
}

/// An expression that is not mixed is one product. Normalised at once: GiNaC has x - 1 as 1 - x in
/// the one run and not in the other, and how many products there are must not depend on that.
Products unmixed(const ex& expression) {
    const auto [coefficient, profile] = normalised_profile(expression);
    return {{coefficient, profile}};
}

/// X(x), T(t) with X + T = expression, if there are such.
std::optional<std::pair<ex, ex>> additive_parts(const ex& expression) {
    ex in_x = 0;
    ex in_t = 0;
    const ex expanded = moderately_expanded(expression);
    if (!is_a<GiNaC::add>(expanded))
        return std::nullopt;
    for (const ex& term : ordered_operands(expanded)) {
        if (is_mixed(term))
            return std::nullopt;
        (has_x(term) ? in_x : in_t) += term;
    }
    return std::pair{in_x, in_t};
}

std::optional<Products> products_of(const ex& expression);

std::optional<Products> products_of_function(const ex& expression) {
    const std::string name = ex_to<GiNaC::function>(expression).get_name();
    const auto parts = additive_parts(expression.op(0));
    if (!parts)
        return std::nullopt;
    const auto& [x, t] = *parts;
    if (name == "exp")
        return Products{{exp(t), exp(x)}};
    if (name == "sin")
        return Products{{cos(t), sin(x)}, {sin(t), cos(x)}};
    if (name == "cos")
        return Products{{cos(t), cos(x)}, {-sin(t), sin(x)}};
    if (name == "sinh")
        return Products{{cosh(t), sinh(x)}, {sinh(t), cosh(x)}};
    if (name == "cosh")
        return Products{{cosh(t), cosh(x)}, {sinh(t), sinh(x)}};
    return std::nullopt;
}

std::optional<Products> products_of_power(const ex& expression) {
    const ex& base = expression.op(0);
    const ex& exponent = expression.op(1);
    if (!has_x(base) && !has_t(base)) {
        const auto parts = additive_parts(exponent);
        if (!parts)
            return std::nullopt;
        return Products{{pow(base, parts->second), pow(base, parts->first)}};
    }
    if (!exponent.info(GiNaC::info_flags::posint) || exponent > largest_distributed_power)
        return std::nullopt;
    const auto factor = products_of(base);
    if (!factor)
        return std::nullopt;
    Products result = *factor;
    for (int i = 1; i < ex_to<numeric>(exponent).to_int(); ++i)
        result = multiplied(result, *factor);
    return result;
}

/// The products of a sum and, added to `rest`, the terms that have none. Terms in x alone stay
/// together, and so do terms in t alone.
Products products_of_sum(const ex& expression, ex& rest) {
    Products result;
    ex in_x = 0;
    ex in_t = 0;
    for (const ex& term : ordered_operands(expression)) {
        if (!is_mixed(term)) {
            (has_x(term) ? in_x : in_t) += term;
        } else if (const auto products = products_of(term)) {
            append(result, *products);
        } else {
            rest += term;
        }
    }
    // A number beside terms in x is part of their profile: x - 1 is one profile.
    if (!in_x.is_zero() && !has_t(in_t)) {
        in_x += in_t;
        in_t = 0;
    }
    if (!in_x.is_zero())
        append(result, unmixed(in_x));
    if (!in_t.is_zero())
        append(result, unmixed(in_t));
    return result;
}

/// The products of an expression that is their sum without rest.
std::optional<Products> products_of(const ex& expression) {
    if (!is_mixed(expression))
        return unmixed(expression);
    if (is_a<GiNaC::add>(expression)) {
        ex rest = 0;
        Products result = products_of_sum(expression, rest);
        return rest.is_zero() ? std::optional(result) : std::nullopt;
    }
    if (is_a<GiNaC::mul>(expression)) {
        Products result = {{1, 1}};
        for (const ex& factor : ordered_operands(expression)) {
            const auto products = products_of(factor);
            if (!products)
                return std::nullopt;
            result = multiplied(result, *products);
        }
        return result;
    }
    if (is_a<GiNaC::power>(expression))
        return products_of_power(expression);
    if (is_a<GiNaC::function>(expression))
        return products_of_function(expression);
    return std::nullopt;
}

/// Normalises the profiles, adds the amplitudes of equal ones, and drops what is zero.
Products merged(const Products& products) {
    Products result;
    for (const SeparatedProduct& product : products) {
        if (is_identically_zero(product.profile))
            continue;
        const auto [coefficient, profile] = normalised_profile(product.profile);
        add_product(result, {coefficient * product.amplitude, profile});
    }
    std::erase_if(result,
                  [](const SeparatedProduct& r) { return is_identically_zero(r.amplitude); });
    return result;
}

/// c and s with expression = c s, where s has leading coefficient 1.
std::pair<ex, ex> normalised_sum(const ex& expression) {
    const GiNaC::exvector terms = ordered_operands(expression);
    const ex coefficient = normalised_profile(terms.front()).first;
    ex sum = 0;
    for (const ex& term : terms)
        sum += term / coefficient;
    return {coefficient, sum};
}

} // namespace

std::pair<ex, ex> normalised_profile(const ex& profile) {
    if (!has_x(profile))
        return {profile, 1};
    if (is_a<GiNaC::add>(profile))
        return normalised_sum(profile);
    if (is_a<GiNaC::power>(profile) && is_a<GiNaC::add>(profile.op(0)) &&
        profile.op(1).info(GiNaC::info_flags::integer)) {
        const auto [coefficient, sum] = normalised_sum(profile.op(0));
        return {pow(coefficient, profile.op(1)), pow(sum, profile.op(1))};
    }
    if (!is_a<GiNaC::mul>(profile))
        return {1, profile};
    ex coefficient = 1;
    ex normalised = 1;
    for (const ex& factor : profile) {
        const auto [c, f] = normalised_profile(factor);
        coefficient *= c;
        normalised *= f;
    }
    return {coefficient, normalised};
}

Separation separated(const ex& expression) {
    try {
        Separation result;
        Products products;
        if (is_a<GiNaC::add>(expression))
            products = products_of_sum(expression, result.rest);
        else if (const auto whole = products_of(expression))
            products = *whole;
        else
            result.rest = expression;
        result.products = merged(products);
        if (is_identically_zero(result.rest))
            result.rest = 0;
        return result;
    } catch (const TooManyProducts&) {
        return {.products = {}, .rest = expression};
    }
}

} // namespace tvbeam
