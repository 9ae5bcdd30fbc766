#include "mms/expression/canonical.hpp"

#include "mms/expression/symbols.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <tuple>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;
using Kind = CanonicalNode::Kind;

std::string number_text(const numeric& value) {
    if (value.is_integer() && value.int_length() < std::numeric_limits<int>::digits)
        return std::to_string(value.to_int());
    if (value.is_rational() && !value.is_integer())
        return number_text(value.numer()) + "/" + number_text(value.denom());
    std::ostringstream stream;
    stream << value;
    return stream.str();
}

namespace {

/// The key of a product without its coefficient, of any other node but a number the key itself.
std::string joined_keys(const CanonicalNode& node, char sign) {
    std::string text;
    for (const Canonical& operand : node.operands)
        text.append(text.empty() ? "" : std::string(1, sign)).append(operand->key);
    return text;
}

/// Of a power of a power, which is which: x^(x^2) is not (x^x)^2.
std::string key_in_power(const CanonicalNode& node) {
    return node.kind == Kind::Power ? "<" + node.key + ">" : node.key;
}

std::string key_of(const CanonicalNode& node) {
    switch (node.kind) {
    case Kind::Number:
        return number_text(node.coefficient);
    case Kind::Name:
        return node.name;
    case Kind::Sum:
        return "(" + joined_keys(node, '+') + ")";
    case Kind::Product:
        return "[" + number_text(node.coefficient) + "*" + joined_keys(node, '*') + "]";
    case Kind::Power:
        return key_in_power(*node.operands[0]) + "^" + key_in_power(*node.operands[1]);
    case Kind::Function:
        return node.name + "{" + joined_keys(node, ' ') + "}";
    }
    return {};
}

Canonical finished(CanonicalNode node) {
    for (const Canonical& operand : node.operands) {
        node.has_x = node.has_x || operand->has_x;
        node.has_t = node.has_t || operand->has_t;
        node.has_symbol = node.has_symbol || operand->has_symbol;
    }
    node.key = key_of(node);
    return std::make_shared<const CanonicalNode>(std::move(node));
}

Canonical number(const numeric& value) {
    CanonicalNode node;
    node.coefficient = value;
    return finished(std::move(node));
}

bool is_integer(const CanonicalNode& node) {
    return node.kind == Kind::Number && node.coefficient.is_integer();
}

numeric coefficient_of(const CanonicalNode& node) {
    return node.kind == Kind::Number || node.kind == Kind::Product ? node.coefficient : numeric(1);
}

/// The power of x, or of t, among the factors of a term.
double degree_in(const CanonicalNode& term, const std::string& name) {
    if (term.kind == Kind::Name)
        return term.name == name ? 1.0 : 0.0;
    if (term.kind == Kind::Power && term.operands[0]->name == name &&
        term.operands[0]->kind == Kind::Name && term.operands[1]->kind == Kind::Number)
        return term.operands[1]->coefficient.to_double();
    double degree = 0.0;
    if (term.kind == Kind::Product)
        for (const Canonical& factor : term.operands)
            degree += degree_in(*factor, name);
    return degree;
}

using Rank = std::tuple<int, double, double, std::string>;

/// The rank of a term does not depend on its coefficient.
Rank rank_in_sum(const CanonicalNode& term) {
    if (term.kind == Kind::Number)
        return {1, 0.0, 0.0, {}};
    return {0, -degree_in(term, "x"), -degree_in(term, "t"),
            term.kind == Kind::Product ? joined_keys(term, '*') : term.key};
}

Rank rank_in_product(const CanonicalNode& factor) {
    int group = 0;
    if (factor.has_x)
        group = 4;
    else if (factor.has_t)
        group = 3;
    else if (factor.has_symbol)
        group = 2;
    else if (factor.kind != Kind::Number)
        group = 1;
    return {group, factor.kind == Kind::Sum ? 1.0 : 0.0, 0.0, factor.key};
}

template <typename Item, typename RankOf>
void sort_by_rank(std::vector<Item>& items, const RankOf& rank_of) {
    std::vector<std::pair<Rank, Item>> ranked;
    ranked.reserve(items.size());
    for (Item& item : items)
        ranked.emplace_back(rank_of(item), std::move(item));
    std::sort(ranked.begin(), ranked.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = std::move(ranked[i].second);
}

Canonical negated(const Canonical& node) {
    if (node->kind == Kind::Number || node->kind == Kind::Product)
        return with_coefficient(*node, -node->coefficient);
    CanonicalNode product;
    product.kind = Kind::Product;
    product.coefficient = -1;
    product.operands = {node};
    return finished(std::move(product));
}

/// A sum with a positive leading term, and whether its sign was changed for that.
std::pair<Canonical, bool> oriented(const Canonical& node) {
    if (node->kind != Kind::Sum || !begins_with_minus(*node))
        return {node, false};
    CanonicalNode sum;
    sum.kind = Kind::Sum;
    for (const Canonical& term : node->operands) {
        // A product with nothing but its factor is that factor.
        const Canonical changed = negated(term);
        const bool bare = changed->kind == Kind::Product && changed->operands.size() == 1 &&
                          changed->coefficient.is_equal(1);
        sum.operands.push_back(bare ? changed->operands.front() : changed);
    }
    return {finished(std::move(sum)), true};
}

Canonical power(const ex& expression) {
    const Canonical exponent = canonical(expression.op(1));
    const auto [base, changed] = is_integer(*exponent)
                                     ? oriented(canonical(expression.op(0)))
                                     : std::pair{canonical(expression.op(0)), false};
    CanonicalNode node;
    node.kind = Kind::Power;
    node.operands = {base, exponent};
    const Canonical result = finished(std::move(node));
    return changed && exponent->coefficient.is_odd() ? negated(result) : result;
}

Canonical product(const ex& expression) {
    CanonicalNode node;
    node.kind = Kind::Product;
    for (const ex& factor : expression) {
        const auto [operand, changed] = oriented(canonical(factor));
        if (changed)
            node.coefficient *= -1;
        node.coefficient *= coefficient_of(*operand);
        if (operand->kind == Kind::Product)
            node.operands.insert(node.operands.end(), operand->operands.begin(),
                                 operand->operands.end());
        else if (operand->kind != Kind::Number)
            node.operands.push_back(operand);
    }
    sort_by_rank(node.operands, [](const Canonical& factor) { return rank_in_product(*factor); });
    return finished(std::move(node));
}

Canonical sum(const ex& expression) {
    CanonicalNode node;
    node.kind = Kind::Sum;
    for (const ex& term : expression)
        node.operands.push_back(canonical(term));
    sort_by_rank(node.operands, [](const Canonical& term) { return rank_in_sum(*term); });
    return finished(std::move(node));
}

Canonical name(const std::string& name) {
    CanonicalNode node;
    node.kind = Kind::Name;
    node.name = name;
    node.has_x = name == "x";
    node.has_t = name == "t";
    node.has_symbol = name != "pi";
    return finished(std::move(node));
}

/// c and s with sum = c s, where the largest coefficient of s is 1 in size.
std::pair<numeric, Canonical> with_largest_coefficient_one(const CanonicalNode& sum) {
    numeric largest = 0;
    for (const Canonical& term : sum.operands)
        largest = std::max(largest, GiNaC::abs(coefficient_of(*term)));
    CanonicalNode scaled;
    scaled.kind = Kind::Sum;
    for (const Canonical& term : sum.operands) {
        if (term->kind == Kind::Number || term->kind == Kind::Product) {
            scaled.operands.push_back(with_coefficient(*term, term->coefficient / largest));
            continue;
        }
        CanonicalNode product;
        product.kind = Kind::Product;
        product.coefficient = 1 / largest;
        product.operands = {term};
        scaled.operands.push_back(finished(std::move(product)));
    }
    return {largest, finished(std::move(scaled))};
}

} // namespace

Canonical canonical(const ex& expression) {
    if (is_a<numeric>(expression))
        return number(ex_to<numeric>(expression));
    if (is_a<GiNaC::symbol>(expression))
        return name(ex_to<GiNaC::symbol>(expression).get_name());
    if (is_a<GiNaC::add>(expression))
        return sum(expression);
    if (is_a<GiNaC::mul>(expression))
        return product(expression);
    if (is_a<GiNaC::power>(expression))
        return power(expression);
    if (!is_a<GiNaC::function>(expression))
        return name("pi");
    CanonicalNode node;
    node.kind = Kind::Function;
    node.name = ex_to<GiNaC::function>(expression).get_name();
    node.operands = {canonical(expression.op(0))};
    return finished(std::move(node));
}

bool begins_with_minus(const CanonicalNode& sum) {
    return coefficient_of(*sum.operands.front()).is_negative();
}

Canonical rescaled(const Canonical& node) {
    CanonicalNode changed = *node;
    changed.operands.clear();
    for (const Canonical& operand : node->operands) {
        const Canonical part = rescaled(operand);
        if (node->kind == Kind::Product && part->kind == Kind::Product) {
            changed.coefficient *= part->coefficient;
            changed.operands.insert(changed.operands.end(), part->operands.begin(),
                                    part->operands.end());
        } else {
            changed.operands.push_back(part);
        }
    }
    const bool is_power_of_sum = node->kind == Kind::Power &&
                                 changed.operands[0]->kind == Kind::Sum &&
                                 is_integer(*changed.operands[1]);
    if (!is_power_of_sum)
        return finished(std::move(changed));
    const auto [largest, sum] = with_largest_coefficient_one(*changed.operands[0]);
    CanonicalNode product;
    product.kind = Kind::Product;
    product.coefficient = GiNaC::pow(largest, changed.operands[1]->coefficient);
    changed.operands[0] = sum;
    product.operands = {finished(std::move(changed))};
    return finished(std::move(product));
}

Canonical with_coefficient(const CanonicalNode& node, const numeric& coefficient) {
    CanonicalNode changed = node;
    changed.coefficient = coefficient;
    return finished(std::move(changed));
}

GiNaC::exvector ordered_operands(const ex& sum_or_product) {
    const bool is_sum = is_a<GiNaC::add>(sum_or_product);
    GiNaC::exvector operands(sum_or_product.begin(), sum_or_product.end());
    sort_by_rank(operands, [is_sum](const ex& operand) {
        const Canonical node = canonical(operand);
        return is_sum ? rank_in_sum(*node) : rank_in_product(*oriented(node).first);
    });
    return operands;
}

} // namespace tvbeam
