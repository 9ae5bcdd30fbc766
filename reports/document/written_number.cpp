#include "reports/document/written_number.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace tvbeam {

std::optional<WrittenNumber> written_number(const std::string& text) {
    std::string_view rest = text;
    // What is at the front and goes with a number; it is taken away.
    const auto digits = [&rest] {
        const std::string_view found =
            rest.substr(0, std::min(rest.find_first_not_of("0123456789"), rest.size()));
        rest.remove_prefix(found.size());
        return std::string(found);
    };
    const auto given = [&rest](std::string_view mark) {
        const bool there = rest.starts_with(mark);
        rest.remove_prefix(there ? mark.size() : 0);
        return there ? std::string(mark) : std::string();
    };
    const auto integer = [&] {
        const std::string sign = given("-");
        const std::string number = digits();
        return number.empty() ? number : sign + number;
    };
    WrittenNumber number;
    number.whole = integer();
    if (number.whole.empty())
        return std::nullopt;
    if (!given(".").empty() && (number.fraction = digits()).empty())
        return std::nullopt;
    if (!given("e").empty() && (number.exponent = integer()).empty())
        return std::nullopt;
    number.suffix = given("*");
    return rest.empty() ? std::optional(number) : std::nullopt;
}

std::vector<TextPiece> pieces_of(const std::string& text) {
    std::vector<TextPiece> pieces;
    const auto add = [&pieces](const std::string& word) {
        auto number = written_number(word);
        if (number && (number->exponent.empty() || !number->suffix.empty()))
            number.reset();
        if (number || pieces.empty() || pieces.back().number)
            pieces.push_back({word, number});
        else
            pieces.back().text += word;
    };
    const std::string between = " ()[],;:=";
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = text.find_first_of(between, at);
        if (end == at) {
            add(text.substr(at++, 1));
            continue;
        }
        end = std::min(end, text.size());
        // The full stop of a sentence is not part of its last number.
        const std::size_t stop = text[end - 1] == '.' ? end - 1 : end;
        if (stop > at)
            add(text.substr(at, stop - at));
        if (stop < end)
            add(".");
        at = end;
    }
    return pieces;
}

NumberColumn number_column(const std::vector<std::string>& cells) {
    NumberColumn column;
    for (const auto& cell : cells) {
        if (cell.empty())
            continue;
        const bool digit = std::isdigit(static_cast<unsigned char>(cell.front())) != 0;
        column.is_text = column.is_text && !digit && cell.front() != '-';
        if (const auto number = written_number(cell)) {
            column.fraction = std::max(column.fraction, number->fraction.size());
            column.exponent = std::max(column.exponent, number->exponent.size());
        }
    }
    return column;
}

} // namespace tvbeam
