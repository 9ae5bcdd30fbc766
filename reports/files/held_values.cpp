#include "reports/files/held_values.hpp"

#include "reports/files/json_values.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr double of_fits = 1e-3;
constexpr double of_path_limits = 0.01;
constexpr double of_half_widths = 0.05;
/// ln 1/x of a width x = 1e-2: where p moves by δ, ln a moves by δ ln 1/x, so that a x^p stays.
constexpr double log_of_widths = 4.6;
constexpr double of_sentences = 1e-3;
constexpr double coarsest_digit = 0.01; // of the number, may be another
constexpr double of_round_off = 4.0;    // a factor
constexpr double zero = zero_value;
constexpr double printed_zero = 1e-13;     // in sentences
constexpr double of_cells = 0.25;          // of tables: of the greater; the numbers stand elsewhere
constexpr double of_round_off_cells = 0.7; // … in rows that have one below:
constexpr double zero_of_cells = 1e-12;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

bool has(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// A number as a sentence has it.
struct PrintedNumber {
    double value = 0.0;
    double unit = 0.0; ///< of its last digit
    std::size_t length = 0;
    bool is_whole = true;
};

/// That which begins at a place, with its sign behind a blank; none behind a letter, as in a name.
std::optional<PrintedNumber> number_at(const std::string& text, std::size_t at) {
    const auto is = [&](std::size_t i, auto test) {
        return i < text.size() && test(static_cast<unsigned char>(text[i])) != 0;
    };
    const bool is_signed = is(at, [](int c) { return c == '-' ? 1 : 0; }) && is(at + 1, isdigit) &&
                           (at == 0 || text[at - 1] == ' ');
    if (!is_signed &&
        (!is(at, isdigit) || (at > 0 && (is(at - 1, isalnum) || text[at - 1] == '_'))))
        return std::nullopt;
    PrintedNumber number;
    const char* begin = text.data() + at;
    const char* end =
        std::from_chars(begin, text.data() + text.size(), number.value, std::chars_format::general)
            .ptr;
    if (end > begin && end[-1] == '.')
        --end; // of the sentence
    number.length = static_cast<std::size_t>(end - begin);
    const std::string_view digits(begin, number.length);
    const std::size_t exponent = std::min(digits.find('e'), digits.size());
    const std::size_t point = std::min(digits.find('.'), exponent);
    int power = 0;
    if (exponent < digits.size()) {
        const std::size_t sign = digits[exponent + 1] == '+' ? 2 : 1;
        std::from_chars(begin + exponent + sign, end, power);
    }
    number.is_whole = point == digits.size();
    if (point < exponent)
        power -= static_cast<int>(exponent - point) - 1;
    number.unit = std::pow(10.0, power);
    return number;
}

/// How far from the first the second of two numbers may be at a place in a sentence.
double slack_in_words(const PrintedNumber& first, const PrintedNumber& second,
                      std::string_view before, std::string_view behind) {
    if (first.is_whole && second.is_whole)
        return 0.0;
    constexpr std::string_view plus_minus = " ± ";
    const bool is_half_width = before.ends_with(plus_minus);
    const double part = is_half_width ? of_half_widths : of_sentences;
    // What is held to a part may be rounded to either side.
    const bool by_a_digit = is_half_width || behind.starts_with(plus_minus) ||
                            first.unit <= coarsest_digit * std::abs(first.value);
    const bool both_zero = !first.is_whole && !second.is_whole &&
                           std::max(std::abs(first.value), std::abs(second.value)) <= printed_zero;
    return both_zero ? printed_zero
                     : part * std::abs(first.value) + (by_a_digit ? 1.01 * first.unit : 0.0);
}

/// Whether a row of a table has a rounding error, and may have what is computed from such.
bool has_round_off(const std::string& row) {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (const auto number = number_at(row, i)) {
            if (number->value != 0.0 && std::abs(number->value) < zero_of_cells)
                return true;
            i += number->length - 1;
        }
    return false;
}

/// How far from the first the second of two numbers of a table may be.
/// before: what stands in front of it.
double slack_in_cells(const PrintedNumber& first, const PrintedNumber& second, double part,
                      std::string_view before) {
    // 0.17(3): of the digit before it, 1 to 9.
    if (before.ends_with('(') && before.size() > 1 && std::isdigit(before[before.size() - 2]) != 0)
        return 8.0;
    if (first.is_whole && second.is_whole)
        return 0.0;
    // 0.00 is what is less than a half of its last digit.
    const auto least = [](const PrintedNumber& one) {
        return one.value == 0.0 && !one.is_whole ? 1.01 * one.unit : zero_of_cells;
    };
    return std::max({part * std::max(std::abs(first.value), std::abs(second.value)), least(first),
                     least(second)});
}

/// Where a line is broken follows the digits of the numbers in it: one blank is as good as the end
/// of a line and the next line's indentation. Steps behind both.
bool steps_over_broken_line(const std::string& before, std::size_t& i, const std::string& now,
                            std::size_t& j) {
    if (!(before[i] == ' ' && now[j] == '\n') && !(before[i] == '\n' && now[j] == ' '))
        return false;
    i = std::min(before.find_first_not_of(" \n", i), before.size());
    j = std::min(now.find_first_not_of(" \n", j), now.size());
    return true;
}

bool same_words(const std::string& before, const std::string& now, bool is_row) {
    const double part =
        is_row && (has_round_off(before) || has_round_off(now)) ? of_round_off_cells : of_cells;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < before.size() && j < now.size()) {
        const auto first = number_at(before, i);
        const auto second = number_at(now, j);
        if (!first || !second) {
            if (steps_over_broken_line(before, i, now, j))
                continue;
            if (before[i++] != now[j++])
                return false;
            continue;
        }
        const std::string_view text = before;
        const double slack = is_row ? slack_in_cells(*first, *second, part, text.substr(0, i))
                                    : slack_in_words(*first, *second, text.substr(0, i),
                                                     text.substr(i + first->length));
        if (!(std::abs(second->value - first->value) <= slack))
            return false;
        i += first->length;
        j += second->length;
    }
    return i == before.size() && j == now.size();
}

/// Recorded numbers by where they stand, and how far from one the same may be.
class Slack {
public:
    Slack(const JsonValues& recorded, double tolerance)
        : recorded_(recorded), tolerance_(tolerance) {}

    [[nodiscard]] bool holds(const std::string& what, double before, double now) const {
        const double size = std::max(std::abs(before), std::abs(now));
        const std::string key = what.substr(what.find_last_of(". ") + 1);
        if (const auto unit = unit_of_round_off(what, key))
            return size <=
                   std::max(*unit, of_round_off * std::min(std::abs(before), std::abs(now)));
        return std::abs(now - before) <= std::max(zero, slack_of(what, key, std::abs(before)));
    }

private:
    /// Of figures of round-off; none: it is no such figure.
    [[nodiscard]] static std::optional<double> unit_of_round_off(const std::string& what,
                                                                 const std::string& key) {
        for (const std::string_view check : {"heat_residual", "beam_residual", "path"})
            if (has(what, "stress.cases") &&
                (has(what, std::string("checks.") + std::string(check) + ".") ||
                 what.ends_with(std::string("checks.") + std::string(check))))
                return 4.0;
        // Of fixed points, which are allowed more than that; less is zero.
        if (has(what, "stress.cases") &&
            (has(what, "checks.energy") || has(what, "checks.initial_state")))
            return zero;
        if (has(what, "stress.roundoff") && is_one_of(key, {"moment", "sine", "hermite"}))
            return 4.0 * zero;
        if (what.ends_with("separation.residual"))
            return 1e-13;
        if (has(what, ": changes.") || has(what, ".changes."))
            return 1e-11;
        return std::nullopt;
    }

    [[nodiscard]] std::optional<double> beside(const std::string& what, const char* name) const {
        const auto found = recorded_.find(what.substr(0, what.find_last_of(". ") + 1) + name);
        return found != recorded_.end() && found->second.is_number()
                   ? std::optional<double>(found->second)
                   : std::nullopt;
    }

    /// How far an order may be from the recorded one by the interval that was recorded with it.
    [[nodiscard]] double of_order(const std::string& what, const std::string& order) const {
        return of_half_widths * beside(what, (order + "_uncertainty").c_str()).value_or(0.0);
    }

    [[nodiscard]] double slack_of(const std::string& what, const std::string& key,
                                  double size) const {
        constexpr double of_what_may_be_zero = 1e-9; // orders, cosines, scatters
        if (key == "rms")                            // of the window of rows that counts
            return 0.5 * size + of_what_may_be_zero;
        if (has(what, "path_limit"))
            return of_path_limits * size;
        if (has(what, "methods.") || has(what, "checks.error") || key == "measured" ||
            has(what, "predicted"))
            return of_fits * size;
        if (is_one_of(key, {"a", "b"}))
            return std::max(of_fits, log_of_widths * of_order(what, key == "a" ? "p" : "q")) * size;
        if (is_one_of(key, {"p", "q"}))
            return std::max(of_fits * size + of_what_may_be_zero, of_order(what, key));
        if (is_one_of(key, {"rho", "p_se", "q_se", "rho_se"}))
            return of_fits * size + of_what_may_be_zero;
        if (key == "order" || has(what, "orders.") || has(what, "order_defect"))
            if (!beside(what, "low") && !key.ends_with("uncertainty"))
                return of_fits;
        if (is_one_of(key, {"a_uncertainty", "b_uncertainty"})) // e^half - 1
            return of_half_widths * (1.0 + size) * std::log1p(size);
        if (key.ends_with("uncertainty"))
            return of_half_widths * size;
        if (const auto low = beside(what, "low"))
            if (const auto high = beside(what, "high"))
                return of_half_widths * (*high - *low) / 2;
        return tolerance_ * size;
    }

    const JsonValues& recorded_;
    double tolerance_;
};

/// "…, sine basis" and "…, nodal values", where another one was asked for.
std::string without_basis(const std::string& text) {
    for (const std::string_view basis :
         {", sine basis or nodal values", ", sine basis", ", nodal values"})
        if (text.ends_with(basis))
            return text.substr(0, text.size() - basis.size());
    return text;
}

bool is_same(const std::string& what, const Json& before, const Json& now, const Slack& slack,
             bool same_basis) {
    if (before == now)
        return true;
    if (before.is_string() && now.is_string()) {
        const std::string first = before;
        const std::string second = now;
        const bool is_row = has(what, "tables ") && has(what, "rows ");
        return same_words(first, second, is_row) ||
               (!same_basis && same_words(without_basis(first), without_basis(second), is_row));
    }
    return before.is_number() && now.is_number() &&
           (before.is_number_float() || now.is_number_float()) && slack.holds(what, before, now);
}

} // namespace

std::vector<ResultDifference> held_values(const Json& recorded, const Json& found,
                                          double tolerance) {
    const bool same_basis = recorded.contains("basis") && found.contains("basis") &&
                            recorded["basis"] == found["basis"];
    const auto leaves_out = [&](const std::string& key) {
        return !same_basis && (key == "basis" || key == "counters" || key == "files");
    };
    const JsonValues before = json_values(recorded, leaves_out);
    const JsonValues now = json_values(found, leaves_out);
    const Slack slack(before, tolerance);
    std::vector<ResultDifference> differences;
    for (const auto& [what, value] : before) {
        const auto other = now.find(what);
        if (other == now.end())
            differences.push_back({what, value.dump(), std::nullopt, std::nullopt});
        else if (!is_same(what, value, other->second, slack, same_basis))
            differences.push_back({what, value.dump(), other->second.dump(), std::nullopt});
    }
    for (const auto& [what, value] : now)
        if (!before.contains(what))
            differences.push_back({what, std::nullopt, value.dump(), std::nullopt});
    return differences;
}

} // namespace tvbeam
