#pragma once

#include "mms/expression/algebra.hpp"
#include "mms/expression/foreign_notation.hpp"
#include "mms/text/characters.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The grammar of all expressions (expression_parser.hpp has it in full), apart from what their
// values are: the scalars of solutions, and the scalars, vectors and matrices of equations.

namespace tvbeam {

namespace grammar {

inline constexpr std::size_t longest_text = 4096;
inline constexpr int deepest_nesting = 100;
inline constexpr std::size_t most_digits = 100;
inline constexpr int largest_decimal_exponent = 400;

inline bool starts_name(char c) {
    return is_letter(c) || c == '_';
}
inline bool continues_name(char c) {
    return starts_name(c) || is_digit(c);
}
inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

inline bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace grammar

/// Reads one text. The Language makes the values, and refuses by AlgebraError:
///
///     sum, difference, product, quotient, power (a, b), negated (a), number (text, value)
///     name (word) → nothing where it is not known; names ()
///     functions () → their names; takes_one (function); call (function, arguments)
///     has_lists; where it is true: list (entries) of "[" sum { "," sum } "]"
template <typename Language>
class Grammar {
public:
    using Value = typename Language::Value;

    Grammar(const SourceText& source, Language& language)
        : source_(source), language_(language), text_(source.text()) {}

    /// The value of the whole text.
    Value whole() {
        if (text_.size() > grammar::longest_text)
            fail(grammar::longest_text,
                 "an expression may have at most " + std::to_string(grammar::longest_text) +
                     " characters; this one has " + std::to_string(text_.size()));
        skip_blanks();
        if (at_end())
            fail(0, "the expression is empty");
        Value result = sum();
        if (!at_end()) {
            if (peek() == ')')
                fail(offset_, "')' without a '(' before it");
            const bool operand = grammar::continues_name(peek()) || peek() == '(' || peek() == '.';
            fail(offset_, "expected an operator or the end, found " + seen() +
                              (operand ? "; a product needs '*'" : advice_on_character(rest())));
        }
        return result;
    }

private:
    /// Counts how deep the recursion is.
    class Level {
    public:
        explicit Level(Grammar& parser) : parser_(parser) {
            // The innermost operand is one more.
            if (++parser_.depth_ > grammar::deepest_nesting + 1)
                parser_.fail(parser_.offset_, "more than " +
                                                  std::to_string(grammar::deepest_nesting) +
                                                  " brackets, signs or powers within each other");
        }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level(Level&&) = delete;
        Level& operator=(const Level&) = delete;
        Level& operator=(Level&&) = delete;

    private:
        Grammar& parser_;
    };

    Value sum() {
        Value result = product();
        while (peek() == '+' || peek() == '-') {
            const std::size_t at = offset_;
            const char sign = take();
            const Value term = product();
            result = placed(at, [&] {
                return sign == '+' ? language_.sum(result, term)
                                   : language_.difference(result, term);
            });
        }
        return result;
    }

    Value product() {
        Value result = with_sign();
        while (peek() == '*' || peek() == '/') {
            const std::size_t at = offset_;
            const char sign = take();
            if (sign == '*' && peek() == '*' && offset_ == at + 1)
                fail(at, "a power is written with '^', not '**'");
            const Value factor = with_sign();
            result = placed(at, [&] {
                return sign == '*' ? language_.product(result, factor)
                                   : language_.quotient(result, factor);
            });
        }
        return result;
    }

    Value with_sign() {
        const Level level(*this);
        if (peek() != '+' && peek() != '-')
            return power();
        const std::size_t at = offset_;
        const char sign = take();
        Value operand = with_sign();
        if (sign == '+')
            return operand;
        return placed(at, [&] { return language_.negated(operand); });
    }

    Value power() {
        Value base = primary();
        if (peek() != '^')
            return base;
        const std::size_t at = offset_;
        take();
        const Value exponent = with_sign();
        return placed(at, [&] { return language_.power(base, exponent); });
    }

    Value primary() {
        if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1))))
            return number();
        if (grammar::starts_name(peek()))
            return name();
        if (peek() == '(')
            return bracketed();
        if constexpr (Language::has_lists)
            if (peek() == '[')
                return list();
        if (at_end())
            fail(offset_, "the expression ends where a number, a name or '(' must follow");
        fail(offset_,
             "expected a number, a name or '(', found " + seen() + advice_on_character(rest()));
    }

    Value bracketed() {
        const std::size_t opening = offset_;
        take();
        Value result = sum();
        close(opening, ')');
        return result;
    }

    void close(std::size_t opening, char bracket) {
        if (peek() == bracket) {
            take();
            return;
        }
        if (at_end())
            fail(opening, std::string("'") + text_[opening] + "' is never closed");
        const bool operand = grammar::continues_name(peek()) || peek() == '(';
        fail(offset_, std::string("expected an operator or '") + bracket + "', found " + seen() +
                          (operand ? "; a product needs '*'" : advice_on_character(rest())));
    }

    Value number() {
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
        if (digits.size() > grammar::most_digits)
            fail(at, "a number may have at most " + std::to_string(grammar::most_digits) +
                         " digits; this one has " + std::to_string(digits.size()));
        exponent += decimal_exponent(at);
        const std::string written(text_.substr(at, offset_ - at));
        skip_blanks();
        return placed(at, [&] {
            return language_.number(
                written, checked_product(GiNaC::numeric(digits.c_str()),
                                         GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(exponent))));
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
            if (exponent > grammar::largest_decimal_exponent)
                fail(at, "the exponent of a number must be at most " +
                             std::to_string(grammar::largest_decimal_exponent) + " in size");
        }
        return negative ? -exponent : exponent;
    }

    Value name() {
        const std::size_t at = offset_;
        while (grammar::continues_name(peek()))
            ++offset_;
        const std::string word(text_.substr(at, offset_ - at));
        skip_blanks();
        if (grammar::contains(language_.functions(), word)) {
            if (peek() != '(')
                fail(at, "the function '" + word + "' needs its argument in brackets" +
                             (peek() == '^' ? ", and its power behind them: " + word + "(…)^2"
                                            : std::string()));
            return call(word, at);
        }
        const std::optional<Value> value = language_.name(word);
        if (!value) {
            if (peek() == '(')
                fail(at, "unknown function '" + word + "'" +
                             hint(word, advice_on_function(word), language_.functions(),
                                  "the functions are "));
            fail(at, "unknown symbol '" + word + "'" +
                         hint(word, advice_on_symbol(word), language_.names(), "known are "));
        }
        return *value;
    }

    Value call(const std::string& function, std::size_t at) {
        const std::size_t opening = offset_;
        take();
        const bool one = language_.takes_one(function);
        if (peek() == ')')
            fail(offset_, "'" + function + "' takes " + (one ? "one argument" : "arguments") +
                              ", none is given");
        std::vector<Value> arguments = {sum()};
        while (peek() == ',') {
            if (one)
                fail(offset_, "'" + function + "' takes one argument, more are given");
            take();
            arguments.push_back(sum());
        }
        close(opening, ')');
        return placed(at, [&] { return language_.call(function, arguments); });
    }

    /// [a, b, c], where the language has lists.
    Value list() {
        const std::size_t opening = offset_;
        take();
        std::vector<Value> entries = {sum()};
        while (peek() == ',') {
            take();
            entries.push_back(sum());
        }
        close(opening, ']');
        return placed(opening, [&] { return language_.list(entries); });
    }

    static std::string hint(const std::string& word, const std::string& advice,
                            const std::vector<std::string>& known,
                            const std::string& introduction) {
        if (!advice.empty())
            return advice;
        const std::string meant = did_you_mean(word, known);
        return meant.empty() ? fmt::format("; {}{}", introduction, fmt::join(known, ", ")) : meant;
    }

    template <typename Operation>
    Value placed(std::size_t at, const Operation& operation) const {
        try {
            return operation();
        } catch (const AlgebraError& error) {
            fail(at, error.what());
        }
    }

    [[noreturn]] void fail(std::size_t at, const std::string& message) const {
        throw InputError(source_.at(at), message);
    }

    [[nodiscard]] std::string_view rest() const {
        return std::string_view(text_).substr(std::min(offset_, text_.size()));
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
        while (grammar::is_blank(peek()))
            ++offset_;
    }

    const SourceText& source_;
    Language& language_;
    std::string_view text_;
    std::size_t offset_ = 0;
    int depth_ = 0;
};

} // namespace tvbeam
