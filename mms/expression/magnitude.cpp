#include "mms/expression/magnitude.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tvbeam {

using Kind = CanonicalNode::Kind;

namespace {

constexpr double room = 500.0;
/// Beyond this, sizes are all the same: none is of use.
constexpr double largest = 1e6;

double logarithm(const GiNaC::numeric& value) {
    if (value.is_zero())
        return 0.0;
    const double size = std::abs(value.to_double());
    if (std::isnormal(size))
        return std::log2(size);
    return double(value.numer().int_length()) - double(value.denom().int_length());
}

/// The size itself from its binary logarithm.
double size(double logarithm) {
    return std::exp2(std::min(logarithm, std::log2(largest)));
}

double of_function(const CanonicalNode& node, const Magnitude& argument) {
    if (node.name == "exp")
        return argument.above * std::numbers::log2e;
    if (node.name == "sinh" || node.name == "cosh")
        return size(argument.whole) * std::numbers::log2e;
    return 0.0;
}

double of_power(const CanonicalNode& node, const Magnitude& base, const Magnitude& exponent) {
    const CanonicalNode& n = *node.operands[1];
    return base.whole * (n.kind == Kind::Number ? n.coefficient.to_double() : size(exponent.whole));
}

double of_sum(const std::vector<Magnitude>& terms) {
    double sum = 0.0;
    double most = -largest;
    for (const Magnitude& term : terms)
        most = std::max(most, term.whole);
    for (const Magnitude& term : terms)
        sum += std::exp2(term.whole - most);
    return most + std::log2(sum);
}

double whole(const CanonicalNode& node, const std::vector<Magnitude>& parts) {
    double product = logarithm(node.coefficient);
    switch (node.kind) {
    case Kind::Number:
        return product;
    case Kind::Name:
        return node.name == "pi" ? std::log2(std::numbers::pi) : 0.0;
    case Kind::Sum:
        return of_sum(parts);
    case Kind::Power:
        return of_power(node, parts[0], parts[1]);
    case Kind::Function:
        return of_function(node, parts[0]);
    case Kind::Product:
        for (const Magnitude& factor : parts)
            product += factor.whole;
    }
    return product;
}

double above(const CanonicalNode& node, double whole, const std::vector<Magnitude>& parts) {
    double sum = 0.0;
    if (node.kind == Kind::Sum)
        for (const Magnitude& term : parts)
            sum += term.above;
    else if (!node.coefficient.is_negative())
        sum = size(whole);
    else if (!node.has_x && !node.has_t)
        sum = -size(whole);
    return sum;
}

} // namespace

Magnitude magnitude(const CanonicalNode& node) {
    std::vector<Magnitude> parts;
    parts.reserve(node.operands.size());
    for (const Canonical& operand : node.operands)
        parts.push_back(magnitude(*operand));
    Magnitude result;
    result.whole = whole(node, parts);
    result.above = above(node, result.whole, parts);
    result.extreme = std::abs(result.whole);
    for (const Magnitude& part : parts)
        result.extreme = std::max(result.extreme, part.extreme);
    if (node.kind == Kind::Product) {
        double sizes = std::abs(logarithm(node.coefficient));
        for (const Magnitude& factor : parts)
            sizes += std::abs(factor.whole);
        result.extreme = std::max(result.extreme, sizes);
    }
    return result;
}

bool fits_doubles(const Magnitude& magnitude) {
    return magnitude.extreme <= room;
}

} // namespace tvbeam
