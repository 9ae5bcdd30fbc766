#include "mms/equations/fields.hpp"

#include "mms/equations/equation_names.hpp"
#include "mms/equations/tensor.hpp"
#include "mms/expression/algebra.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::is_a;

namespace {

constexpr int highest_order = 8;
constexpr std::size_t most_fields = 1000;
constexpr double largest_derivative_ahead = 200'000;
constexpr double largest_substitution = 20'000;

/// Nodes of an expression, and about how many its derivative may have before anything cancels.
struct Growth {
    double nodes = 1.0;
    double derivative = 1.0;
};

Growth growth_of(const ex& expression) {
    Growth whole;
    double factors = 0.0;
    for (const ex& operand : expression) {
        const Growth part = growth_of(operand);
        whole.nodes += part.nodes;
        whole.derivative += part.derivative;
        ++factors;
    }
    // Of a product each term repeats all factors; of a power and a function the argument.
    if (is_a<GiNaC::mul>(expression))
        whole.derivative += factors * whole.nodes;
    else if (factors > 0.0 && !is_a<GiNaC::add>(expression))
        whole.derivative += 2.0 * whole.nodes;
    return whole;
}

void collect_symbols(const ex& expression, std::set<std::string>& names) {
    if (is_a<GiNaC::symbol>(expression))
        names.insert(GiNaC::ex_to<GiNaC::symbol>(expression).get_name());
    for (const ex& operand : expression)
        collect_symbols(operand, names);
}

double nodes_with(const ex& expression, const std::map<std::string, double>& sizes) {
    double nodes = 1.0;
    if (is_a<GiNaC::symbol>(expression)) {
        const auto found = sizes.find(GiNaC::ex_to<GiNaC::symbol>(expression).get_name());
        nodes = found == sizes.end() ? 1.0 : found->second;
    }
    for (const ex& operand : expression)
        nodes += nodes_with(operand, sizes);
    return nodes;
}

std::string field_name(const std::string& unknown, const Orders& orders) {
    std::string suffix;
    for (std::size_t i = 0; i < coordinate_count; ++i)
        suffix += std::string(static_cast<std::size_t>(orders[i]), coordinate_names()[i].front());
    return suffix.empty() ? unknown : unknown + "_" + suffix;
}

} // namespace

const GiNaC::symbol& coordinate(std::size_t index) {
    static const std::array<GiNaC::realsymbol, coordinate_count> symbols = {
        GiNaC::realsymbol("x"), GiNaC::realsymbol("y"), GiNaC::realsymbol("z"),
        GiNaC::realsymbol("t")};
    return symbols.at(index);
}

ex plain_derivative(const ex& expression, const GiNaC::symbol& symbol) {
    if (!(growth_of(expression).derivative <= largest_derivative_ahead))
        throw AlgebraError("the derivatives are too large; write it with fewer factors or less "
                           "deeply nested functions");
    return derivative(expression, symbol);
}

ex Fields::add(const std::string& unknown, const ex& exact) {
    fields_.push_back({unknown, {}, GiNaC::realsymbol(unknown), exact});
    by_name_[unknown] = &fields_.back();
    return fields_.back().symbol;
}

const EquationField* Fields::find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
}

const EquationField& Fields::of(const std::string& unknown, const Orders& orders) {
    const std::string name = field_name(unknown, orders);
    if (const EquationField* known = find(name))
        return *known;
    if (std::accumulate(orders.begin(), orders.end(), 0) > highest_order)
        throw AlgebraError("a derivative of " + unknown + " of an order above " +
                           std::to_string(highest_order) + " is asked for; that is the highest");
    if (fields_.size() >= most_fields)
        throw AlgebraError("more than " + std::to_string(most_fields) +
                           " unknowns and derivatives of them are asked for");
    // One derivative of a field with one order less.
    const auto last = std::find_if(orders.rbegin(), orders.rend(), [](int n) { return n > 0; });
    const auto at = static_cast<std::size_t>(orders.rend() - last) - 1;
    Orders lower = orders;
    --lower[at];
    const ex exact = plain_derivative(of(unknown, lower).exact, coordinate(at));
    fields_.push_back({unknown, orders, GiNaC::realsymbol(name), exact});
    by_name_[name] = &fields_.back();
    return fields_.back();
}

std::vector<const EquationField*> Fields::occurring_in(const ex& expression) const {
    std::set<std::string> names;
    collect_symbols(expression, names);
    std::vector<const EquationField*> result;
    for (const EquationField& field : fields_)
        if (names.contains(field.symbol.get_name()))
            result.push_back(&field);
    return result;
}

ex Fields::derivative(const ex& expression, std::size_t coordinate) {
    ex result = plain_derivative(expression, tvbeam::coordinate(coordinate));
    for (const EquationField* field : occurring_in(expression)) {
        Orders higher = field->orders;
        ++higher[coordinate];
        const ex slope = plain_derivative(expression, field->symbol);
        result = checked_sum(result, checked_product(slope, of(field->unknown, higher).symbol));
    }
    require_moderate(result);
    return result;
}

ex Fields::exact(const ex& expression) const {
    GiNaC::exmap values;
    std::map<std::string, double> sizes;
    for (const EquationField* field : occurring_in(expression)) {
        values[field->symbol] = field->exact;
        sizes[field->symbol.get_name()] = growth_of(field->exact).nodes;
    }
    if (nodes_with(expression, sizes) > largest_substitution)
        throw AlgebraError("with the exact solution put in it would have more than 20 000 nodes");
    return substituted(expression, values);
}

} // namespace tvbeam
