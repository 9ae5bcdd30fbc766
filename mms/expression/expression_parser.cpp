#include "mms/expression/expression_parser.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/text/characters.hpp"
#include "mms/text/nearest_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace tvbeam {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr std::size_t longest_text = 4096;
constexpr int deepest_nesting = 100;
constexpr std::size_t most_digits = 100;
constexpr int largest_decimal_exponent = 400;

bool starts_name(char c) {
    return is_letter(c) || c == '_';
}
bool continues_name(char c) {
    return starts_name(c) || is_digit(c);
}
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

class Parser {
public:
    Parser(const SourceText& source, const SymbolTable& symbols, PlainExpression* plain)
        : source_(source), symbols_(symbols), plain_(plain), text_(source.text()) {}

    ex whole() {
        if (text_.size() > longest_text)
            fail(longest_text, "an expression may have at most " + std::to_string(longest_text) +
                                   " characters; this one has " + std::to_string(text_.size()));
        skip_blanks();
        if (at_end())
            fail(0, "the expression is empty");
        ex result = sum();
        if (!at_end()) {
            if (peek() == ')')
                fail(offset_, "')' without a '(' before it");
            const bool operand = continues_name(peek()) || peek() == '(' || peek() == '.';
            fail(offset_, "expected an operator or the end, found " + seen() +
                              (operand ? "; a product needs '*'" : ""));
        }
        return result;
    }

private:
    /// Counts how deep the recursion is.
    class Level {
    public:
        explicit Level(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > deepest_nesting)
                parser_.fail(parser_.offset_, "more than " + std::to_string(deepest_nesting) +
                                                  " brackets, signs or powers within each other");
        }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level(Level&&) = delete;
        Level& operator=(const Level&) = delete;
        Level& operator=(Level&&) = delete;

    private:
        Parser& parser_;
    };

    ex sum() {
        ex result = product();
        while (peek() == '+' || peek() == '-') {
            const std::size_t at = offset_;
            const char sign = take();
            const ex term = product();
            result = placed(at, [&] {
                return sign == '+' ? checked_sum(result, term) : checked_difference(result, term);
            });
            record(sign == '+' ? PlainStep::Kind::Add : PlainStep::Kind::Subtract);
        }
        return result;
    }

    ex product() {
        ex result = with_sign();
        while (peek() == '*' || peek() == '/') {
            const std::size_t at = offset_;
            const char sign = take();
            if (sign == '*' && peek() == '*' && offset_ == at + 1)
                fail(at, "a power is written with '^', not '**'");
            const ex factor = with_sign();
            result = placed(at, [&] {
                return sign == '*' ? checked_product(result, factor)
                                   : checked_quotient(result, factor);
            });
            record(sign == '*' ? PlainStep::Kind::Multiply : PlainStep::Kind::Divide);
        }
        return result;
    }

    ex with_sign() {
        const Level level(*this);
        if (peek() != '+' && peek() != '-')
            return power();
        const std::size_t at = offset_;
        const char sign = take();
        const ex operand = with_sign();
        if (sign == '+')
            return operand;
        record(PlainStep::Kind::Negate);
        return placed(at, [&] { return checked_product(-1, operand); });
    }

    ex power() {
        ex base = primary();
        if (peek() != '^')
            return base;
        const std::size_t at = offset_;
        take();
        const ex exponent = with_sign();
        record(PlainStep::Kind::Power);
        return placed(at, [&] { return checked_power(base, exponent); });
    }

    ex primary() {
        if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1))))
            return number();
        if (starts_name(peek()))
            return name();
        if (peek() == '(')
            return bracketed();
        if (at_end())
            fail(offset_, "the expression ends where a number, a name or '(' must follow");
        fail(offset_, "expected a number, a name or '(', found " + seen());
    }

    ex bracketed() {
        const std::size_t opening = offset_;
        take();
        ex result = sum();
        close(opening);
        return result;
    }

    void close(std::size_t opening) {
        if (peek() == ')') {
            take();
            return;
        }
        if (at_end())
            fail(opening, "'(' is never closed");
        const bool operand = continues_name(peek()) || peek() == '(';
        fail(offset_, "expected an operator or ')', found " + seen() +
                          (operand ? "; a product needs '*'" : ""));
    }

    ex number() {
        const std::size_t at = offset_;
        std::string digits;
        int exponent = 0;
        for (; is_digit(peek()); ++offset_)
            digits += peek();
        if (peek() == '.') {
            for (++offset_; is_digit(peek()); ++offset_) {
                digits += peek();
                --exponent;
            }
        }
        if (digits.size() > most_digits)
            fail(at, "a number may have at most " + std::to_string(most_digits) +
                         " digits; this one has " + std::to_string(digits.size()));
        exponent += decimal_exponent(at);
        record(PlainStep::Kind::Number, std::string(text_.substr(at, offset_ - at)));
        skip_blanks();
        return placed(at, [&] {
            return checked_product(numeric(digits.c_str()),
                                   GiNaC::pow(numeric(10), numeric(exponent)));
        });
    }

    int decimal_exponent(std::size_t at) {
        if (peek() != 'e' && peek() != 'E')
            return 0;
        const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
        if (!is_digit(peek(1 + sign)))
            return 0;
        const bool negative = peek(1) == '-';
        offset_ += 1 + sign;
        int exponent = 0;
        for (; is_digit(peek()); ++offset_) {
            exponent = exponent * 10 + (peek() - '0');
            if (exponent > largest_decimal_exponent)
                fail(at, "the exponent of a number must be at most " +
                             std::to_string(largest_decimal_exponent) + " in size");
        }
        return negative ? -exponent : exponent;
    }

    ex name() {
        const std::size_t at = offset_;
        while (continues_name(peek()))
            ++offset_;
        const std::string word(text_.substr(at, offset_ - at));
        skip_blanks();
        if (contains(function_names(), word)) {
            if (peek() != '(')
                fail(at, "the function '" + word + "' needs its argument in brackets");
            return call(word, at);
        }
        const auto symbol = symbols_.find(word);
        if (symbol == symbols_.end() && word != "pi") {
            if (peek() == '(')
                fail(at, "unknown function '" + word + "'" +
                             hint(word, function_names(), "the functions are "));
            fail(at, "unknown symbol '" + word + "'" + hint(word, symbol_names(), "known are "));
        }
        record(PlainStep::Kind::Name, word);
        return word == "pi" ? ex(GiNaC::Pi) : symbol->second;
    }

    ex call(const std::string& function, std::size_t at) {
        const std::size_t opening = offset_;
        take();
        if (peek() == ')')
            fail(offset_, "'" + function + "' takes one argument, none is given");
        const ex argument = sum();
        if (peek() == ',')
            fail(offset_, "'" + function + "' takes one argument, more are given");
        close(opening);
        record(PlainStep::Kind::Function, function);
        return placed(at, [&] { return checked_function(function, argument); });
    }

    void record(PlainStep::Kind kind, std::string text = {}) {
        if (plain_)
            plain_->push_back({kind, std::move(text)});
    }

    [[nodiscard]] std::vector<std::string> symbol_names() const {
        std::vector<std::string> names = {"pi"};
        for (const auto& [name, symbol] : symbols_)
            names.push_back(name);
        return names;
    }

    static std::string hint(const std::string& word, const std::vector<std::string>& known,
                            const std::string& introduction) {
        const std::string meant = did_you_mean(word, known);
        return meant.empty() ? fmt::format("; {}{}", introduction, fmt::join(known, ", ")) : meant;
    }

    template <typename Operation>
    ex placed(std::size_t at, const Operation& operation) const {
        try {
            return operation();
        } catch (const AlgebraError& error) {
            fail(at, error.what());
        }
    }

    [[noreturn]] void fail(std::size_t at, const std::string& message) const {
        throw InputError(source_.at(at), message);
    }

    /// The next character, as a message shows it.
    [[nodiscard]] std::string seen() const {
        const auto byte = static_cast<std::uint8_t>(peek());
        if (at_end())
            return "the end";
        if (byte >= 0x20U && byte < 0x7FU)
            return std::string{'\'', peek(), '\''};
        std::size_t size = 1;
        while (offset_ + size < text_.size() && size < 4 &&
               (static_cast<std::uint8_t>(text_[offset_ + size]) & 0xC0U) == 0x80U)
            ++size;
        if (byte >= 0xC0U && size > 1)
            return std::string("'").append(text_.substr(offset_, size)).append("'");
        std::array<char, 16> code{};
        std::snprintf(code.data(), code.size(), "byte 0x%02X", static_cast<unsigned>(byte));
        return code.data();
    }

    [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return offset_ + ahead < text_.size() ? text_[offset_ + ahead] : '\0';
    }
    char take() {
        const char taken = peek();
        ++offset_;
        skip_blanks();
        return taken;
    }
    void skip_blanks() {
        while (is_blank(peek()))
            ++offset_;
    }

    const SourceText& source_;
    const SymbolTable& symbols_;
    PlainExpression* plain_;
    std::string_view text_;
    std::size_t offset_ = 0;
    int depth_ = 0;
};

} // namespace

ex parse_expression(const SourceText& source, const SymbolTable& symbols, PlainExpression* plain) {
    return Parser(source, symbols, plain).whole();
}

std::optional<Place> first_use(const SourceText& source, const std::string& name) {
    const std::string& text = source.text();
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        const bool starts = at == 0 || !continues_name(text[at - 1]);
        const bool ends = end == text.size() || !continues_name(text[end]);
        if (starts && ends)
            return source.at(at);
    }
    return std::nullopt;
}

} // namespace tvbeam
