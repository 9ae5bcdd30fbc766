#include "reports/document/written_number.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace tvbeam {

std::optional<WrittenNumber> written_number(const std::string& text) {
    static const std::regex form("(-?[0-9]+)(?:\\.([0-9]+))?(?:e(-?[0-9]+))?((?:µ|m|n)?\\*?)");
    std::smatch parts;
    if (!std::regex_match(text, parts, form))
        return std::nullopt;
    return WrittenNumber{parts[1], parts[2], parts[3], parts[4]};
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
