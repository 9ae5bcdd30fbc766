#include "mms/expression/expression_parser.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/grammar.hpp"

#include <utility>
#include <vector>

namespace tvbeam {

using GiNaC::ex;

namespace {

/// What solutions are written in: real numbers, and each step as it is written besides.
class ScalarLanguage {
public:
    using Value = ex;
    static constexpr bool has_lists = false;

    ScalarLanguage(const SymbolTable& symbols, PlainExpression* plain)
        : symbols_(symbols), plain_(plain) {}

    ex sum(const ex& a, const ex& b) {
        record(PlainStep::Kind::Add);
        return checked_sum(a, b);
    }
    ex difference(const ex& a, const ex& b) {
        record(PlainStep::Kind::Subtract);
        return checked_difference(a, b);
    }
    ex product(const ex& a, const ex& b) {
        record(PlainStep::Kind::Multiply);
        return checked_product(a, b);
    }
    ex quotient(const ex& a, const ex& b) {
        record(PlainStep::Kind::Divide);
        return checked_quotient(a, b);
    }
    ex negated(const ex& a) {
        record(PlainStep::Kind::Negate);
        return checked_product(-1, a);
    }
    ex power(const ex& base, const ex& exponent) {
        record(PlainStep::Kind::Power);
        return checked_power(base, exponent);
    }
    ex number(const std::string& written, const ex& value) {
        record(PlainStep::Kind::Number, written);
        return value;
    }

    std::optional<ex> name(const std::string& word) {
        const auto symbol = symbols_.find(word);
        if (symbol == symbols_.end() && word != "pi")
            return std::nullopt;
        record(PlainStep::Kind::Name, word);
        return word == "pi" ? ex(GiNaC::Pi) : symbol->second;
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> names = {"pi"};
        for (const auto& [name, symbol] : symbols_)
            names.push_back(name);
        return names;
    }

    [[nodiscard]] static const std::vector<std::string>& functions() { return function_names(); }
    [[nodiscard]] static bool takes_one(const std::string& /*function*/) { return true; }
    ex call(const std::string& function, const std::vector<ex>& arguments) {
        record(PlainStep::Kind::Function, function);
        return checked_function(function, arguments.front());
    }

private:
    void record(PlainStep::Kind kind, std::string text = {}) {
        if (plain_)
            plain_->push_back({kind, std::move(text)});
    }

    const SymbolTable& symbols_;
    PlainExpression* plain_;
};

} // namespace

ex parse_expression(const SourceText& source, const SymbolTable& symbols, PlainExpression* plain) {
    ScalarLanguage language(symbols, plain);
    return Grammar<ScalarLanguage>(source, language).whole();
}

std::optional<Place> first_use(const SourceText& source, const std::string& name) {
    const std::string& text = source.text();
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool starts = at == 0 || !grammar::continues_name(text[at - 1]);
        const bool ends = end == text.size() || !grammar::continues_name(text[end]);
        if (starts && ends)
            return source.at(at);
    }
    return std::nullopt;
}

} // namespace tvbeam
