#include "mms/expression/printing.hpp"

#include "mms/expression/canonical.hpp"
#include "mms/text/characters.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace tvbeam {

using GiNaC::numeric;
using Kind = CanonicalNode::Kind;

namespace {

/// How tightly a piece of printed text holds together.
enum class Binding { Sum, Product, Power, Atom };

struct Printed {
    std::string text;
    Binding binding = Binding::Atom;
};

/// A power with the exponent's sign changed, for the denominator.
struct Factor {
    Canonical base;
    numeric exponent = 1; ///< 1: the base itself, whatever it is
};

/// ± coefficient · numerator / denominator
struct Fraction {
    bool negative = false;
    numeric coefficient = 1;
    std::vector<Factor> numerator;
    std::vector<Factor> denominator;
};

Fraction fraction_of(const Canonical& node) {
    Fraction result;
    const bool has_coefficient = node->kind == Kind::Product || node->kind == Kind::Number;
    if (has_coefficient) {
        result.negative = node->coefficient.is_negative();
        result.coefficient = GiNaC::abs(node->coefficient);
    }
    std::vector<Canonical> factors = {node};
    if (has_coefficient)
        factors = node->operands;
    for (const Canonical& factor : factors) {
        const bool numerical_power =
            factor->kind == Kind::Power && factor->operands[1]->kind == Kind::Number;
        if (numerical_power && factor->operands[1]->coefficient.is_negative())
            result.denominator.push_back({factor->operands[0], -factor->operands[1]->coefficient});
        else
            result.numerator.push_back({factor});
    }
    return result;
}

/// What text and LaTeX do differently.
class Writer {
public:
    Writer() = default;
    Writer(const Writer&) = delete;
    Writer(Writer&&) = delete;
    Writer& operator=(const Writer&) = delete;
    Writer& operator=(Writer&&) = delete;
    virtual ~Writer() = default;

    [[nodiscard]] Printed print(const Canonical& node) const {
        switch (node->kind) {
        case Kind::Sum:
            return sum(*node);
        case Kind::Name:
            return {symbol(node->name)};
        case Kind::Function:
            return function(node->name, print(node->operands[0]).text);
        case Kind::Power:
            if (const Canonical& exponent = node->operands[1]; exponent->kind != Kind::Number)
                return raised(at_least(Binding::Atom, print(node->operands[0])), print(exponent));
            else if (!exponent->coefficient.is_negative())
                return power({node->operands[0], exponent->coefficient});
            [[fallthrough]];
        default:
            return signed_product(fraction_of(node));
        }
    }

protected:
    [[nodiscard]] virtual std::string symbol(const std::string& name) const = 0;
    [[nodiscard]] virtual Printed function(const std::string& name,
                                           const std::string& argument) const = 0;
    [[nodiscard]] virtual std::string bracketed(const std::string& text) const = 0;
    [[nodiscard]] virtual Printed raised(const std::string& base,
                                         const Printed& exponent) const = 0;
    [[nodiscard]] virtual std::string times(const std::string& left,
                                            const std::string& right) const = 0;
    [[nodiscard]] virtual std::string over(const Printed& numerator,
                                           const Printed& denominator) const = 0;

private:
    [[nodiscard]] std::string at_least(Binding binding, const Printed& printed) const {
        return printed.binding < binding ? bracketed(printed.text) : printed.text;
    }

    [[nodiscard]] Printed power(const Factor& factor) const {
        if (factor.exponent.is_equal(1))
            return print(factor.base);
        if (factor.exponent.is_equal(numeric(1, 2)))
            return function("sqrt", print(factor.base).text);
        const Binding binding = factor.exponent.is_integer() ? Binding::Atom : Binding::Product;
        return raised(at_least(Binding::Atom, print(factor.base)),
                      {number_text(factor.exponent), binding});
    }

    [[nodiscard]] Printed joined(const numeric& number, const std::vector<Factor>& factors) const {
        if (factors.empty())
            return {number_text(number)};
        if (factors.size() == 1 && number.is_equal(1))
            return power(factors.front());
        std::string text = number.is_equal(1) ? "" : number_text(number);
        for (const Factor& factor : factors) {
            const std::string next = at_least(Binding::Power, power(factor));
            text = text.empty() ? next : times(text, next);
        }
        return {text, Binding::Product};
    }

    [[nodiscard]] Printed product(const Fraction& fraction) const {
        Printed above = joined(fraction.coefficient.numer(), fraction.numerator);
        const numeric below = fraction.coefficient.denom();
        if (fraction.denominator.empty() && below.is_equal(1))
            return above;
        return {over(above, joined(below, fraction.denominator)), Binding::Product};
    }

    [[nodiscard]] Printed signed_product(const Fraction& fraction) const {
        Printed magnitude = product(fraction);
        if (!fraction.negative)
            return magnitude;
        return {"-" + at_least(Binding::Product, magnitude), Binding::Sum};
    }

    [[nodiscard]] Printed sum(const CanonicalNode& node) const {
        std::vector<Fraction> terms;
        for (const Canonical& term : node.operands)
            terms.push_back(fraction_of(term));
        // `1 - x` reads better than `-x + 1`.
        const auto positive = std::find_if(terms.begin(), terms.end(),
                                           [](const Fraction& term) { return !term.negative; });
        if (positive != terms.end())
            std::rotate(terms.begin(), positive, positive + 1);
        std::string text;
        for (const Fraction& term : terms) {
            if (text.empty())
                text = term.negative ? "-" : "";
            else
                text += term.negative ? " - " : " + ";
            text += at_least(Binding::Product, product(term));
        }
        return {text, Binding::Sum};
    }
};

class TextWriter final : public Writer {
    [[nodiscard]] std::string symbol(const std::string& name) const override { return name; }
    [[nodiscard]] Printed function(const std::string& name,
                                   const std::string& argument) const override {
        return {name + "(" + argument + ")"};
    }
    [[nodiscard]] std::string bracketed(const std::string& text) const override {
        return "(" + text + ")";
    }
    [[nodiscard]] Printed raised(const std::string& base, const Printed& exponent) const override {
        return {base + "^" +
                    (exponent.binding < Binding::Atom ? bracketed(exponent.text) : exponent.text),
                Binding::Power};
    }
    [[nodiscard]] std::string times(const std::string& left,
                                    const std::string& right) const override {
        return left + "*" + right;
    }
    [[nodiscard]] std::string over(const Printed& numerator,
                                   const Printed& denominator) const override {
        return (numerator.binding < Binding::Product ? bracketed(numerator.text) : numerator.text) +
               "/" +
               (denominator.binding < Binding::Power ? bracketed(denominator.text)
                                                     : denominator.text);
    }
};

class LatexWriter final : public Writer {
public:
    explicit LatexWriter(const std::map<std::string, std::string>& names) : names_(names) {}

private:
    [[nodiscard]] std::string symbol(const std::string& name) const override {
        static const std::map<std::string, std::string> known = {
            {"pi", "\\pi"},       {"alpha", "\\alpha"},     {"beta", "\\beta"},
            {"gamma", "\\gamma"}, {"delta", "\\delta"},     {"epsilon", "\\epsilon"},
            {"zeta", "\\zeta"},   {"eta", "\\eta"},         {"theta", "\\theta"},
            {"kappa", "\\kappa"}, {"lambda", "\\lambda"},   {"mu", "\\mu"},
            {"nu", "\\nu"},       {"rho", "\\rho"},         {"sigma", "\\sigma"},
            {"tau", "\\tau"},     {"phi", "\\phi"},         {"psi", "\\psi"},
            {"omega", "\\omega"}, {"theta_A", "\\theta_A"},
        };
        for (const auto* table : {&names_, &known})
            if (const auto found = table->find(name); found != table->end())
                return found->second;
        if (name.size() == 1 && is_letter(name.front()))
            return name;
        const bool numbered =
            is_letter(name.front()) && std::all_of(name.begin() + 1, name.end(), is_digit);
        if (numbered)
            return name.substr(0, 1) + "_{" + name.substr(1) + "}";
        std::string escaped;
        for (const char c : name)
            escaped += c == '_' ? std::string("\\_") : std::string(1, c);
        return "\\mathit{" + escaped + "}";
    }
    [[nodiscard]] Printed function(const std::string& name,
                                   const std::string& argument) const override {
        static const std::map<std::string, std::string> renamed = {
            {"asin", "arcsin"}, {"acos", "arccos"}, {"atan", "arctan"}, {"log", "ln"}};
        if (name == "exp")
            return {"e^{" + argument + "}", Binding::Power};
        if (name == "sqrt")
            return {"\\sqrt{" + argument + "}"};
        const auto found = renamed.find(name);
        return {"\\" + (found == renamed.end() ? name : found->second) + bracketed(argument),
                Binding::Power};
    }
    [[nodiscard]] std::string bracketed(const std::string& text) const override {
        return "\\left(" + text + "\\right)";
    }
    [[nodiscard]] Printed raised(const std::string& base, const Printed& exponent) const override {
        return {base + "^{" + exponent.text + "}", Binding::Power};
    }
    [[nodiscard]] std::string times(const std::string& left,
                                    const std::string& right) const override {
        // Two numbers side by side would read as one.
        return left + (is_digit(right.front()) ? " \\cdot " : " ") + right;
    }
    [[nodiscard]] std::string over(const Printed& numerator,
                                   const Printed& denominator) const override {
        return "\\frac{" + numerator.text + "}{" + denominator.text + "}";
    }

    const std::map<std::string, std::string>& names_;
};

} // namespace

std::string formula_text(const GiNaC::ex& expression) {
    return TextWriter().print(canonical(expression)).text;
}

std::string formula_latex(const GiNaC::ex& expression) {
    return formula_latex_named(expression, {});
}

std::string formula_latex_named(const GiNaC::ex& expression,
                                const std::map<std::string, std::string>& names) {
    return LatexWriter(names).print(canonical(expression)).text;
}

} // namespace tvbeam
