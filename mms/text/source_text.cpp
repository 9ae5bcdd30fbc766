#include "mms/text/source_text.hpp"

#include "mms/text/characters.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace tvbeam {

namespace {

/// Whether a byte continues a UTF-8 code point, and so takes no column of its own.
bool continues_code_point(char byte) {
    return (static_cast<std::uint8_t>(byte) & 0xC0U) == 0x80U;
}

/// Walks over a document, keeping line and column.
class Walker {
public:
    explicit Walker(std::string_view document) : document_(document) {
        if (document_.starts_with(byte_order_mark))
            offset_ = byte_order_mark.size();
    }

    [[nodiscard]] bool at_end() const { return offset_ >= document_.size(); }
    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return offset_ + ahead < document_.size() ? document_[offset_ + ahead] : '\0';
    }
    [[nodiscard]] bool sees(std::string_view text) const {
        return document_.substr(std::min(offset_, document_.size()), text.size()) == text;
    }
    [[nodiscard]] int line() const { return line_; }
    [[nodiscard]] int column() const { return column_; }
    [[nodiscard]] LineIndex::Mark mark() const { return {offset_, line_, column_}; }
    void begin_at(const LineIndex::Mark& mark) {
        offset_ = mark.offset;
        line_ = mark.line;
        column_ = mark.column;
    }

    void step() {
        if (at_end())
            return;
        if (peek() == '\n') {
            ++line_;
            column_ = 1;
        } else if (!continues_code_point(peek(1))) {
            ++column_;
        }
        ++offset_;
    }
    void step(std::size_t count) {
        for (; count > 0; --count)
            step();
    }
    void go_to(int line, int column) {
        while (!at_end() && (line_ < line || (line_ == line && column_ < column)))
            step();
    }

private:
    std::string_view document_;
    std::size_t offset_ = 0;
    int line_ = 1;
    int column_ = 1;
};

std::size_t utf8_size(std::uint32_t code_point) {
    if (code_point < 0x80U)
        return 1;
    if (code_point < 0x800U)
        return 2;
    return code_point < 0x10000U ? 3 : 4;
}

/// Steps over one escape sequence \…; the number of bytes it stands for.
std::size_t step_over_escape(Walker& walker) {
    const char kind = walker.peek(1);
    walker.step(2);
    if (kind != 'u' && kind != 'U')
        return 1;
    std::uint32_t code_point = 0;
    for (int digits = kind == 'u' ? 4 : 8; digits > 0; --digits) {
        const char digit = walker.peek();
        const int value = digit <= '9' ? digit - '0' : (digit | 0x20) - 'a' + 10;
        code_point = code_point * 16U + static_cast<std::uint32_t>(value);
        walker.step();
    }
    return utf8_size(code_point);
}

/// Whether what follows a backslash, up to the end of the line, is blank: TOML then drops the
/// line's end and all blanks that follow.
bool escapes_line_end(const Walker& walker) {
    std::size_t ahead = 1;
    while (walker.peek(ahead) == ' ' || walker.peek(ahead) == '\t' || walker.peek(ahead) == '\r')
        ++ahead;
    return walker.peek(ahead) == '\n';
}

} // namespace

LineIndex::LineIndex(std::string_view text) {
    constexpr std::size_t distance = 2048;
    for (Walker walker(text); !walker.at_end(); walker.step())
        if (walker.mark().offset % distance == 0)
            marks_.push_back(walker.mark());
}

LineIndex::Mark LineIndex::before(int line, int column) const {
    const auto behind = [](const Mark& place, const Mark& mark) {
        return std::pair(place.line, place.column) < std::pair(mark.line, mark.column);
    };
    const auto next = std::upper_bound(marks_.begin(), marks_.end(), Mark{0, line, column}, behind);
    // Within a code point its column is that of the point before.
    return std::distance(marks_.begin(), next) < 2 ? Mark{0, 1, 1} : *std::prev(next, 2);
}

SourceText::SourceText(std::string text, const Place& first)
    : text_(std::move(text)), file_(first.file) {
    positions_.reserve(text_.size() + 1);
    Position position{first.line, first.column};
    for (std::size_t i = 0; i < text_.size(); ++i) {
        positions_.push_back(position);
        if (i + 1 < text_.size() && continues_code_point(text_[i + 1]))
            continue;
        ++position.column;
    }
    positions_.push_back(position);
}

SourceText SourceText::of_toml_string(std::string value, std::string_view document,
                                      const Place& opening, const LineIndex& lines) {
    SourceText result(std::move(value), opening);
    Walker walker(document);
    if (const LineIndex::Mark mark = lines.before(opening.line, opening.column); mark.offset > 0)
        walker.begin_at(mark);
    walker.go_to(opening.line, opening.column);

    const char quote = walker.peek();
    if (quote != '"' && quote != '\'')
        return result;
    const std::string triple(3, quote);
    const bool many_lines = walker.sees(triple);
    const bool escapes = quote == '"';
    walker.step(many_lines ? 3 : 1);
    if (many_lines && walker.sees("\r\n"))
        walker.step();
    if (many_lines && walker.peek() == '\n')
        walker.step();

    std::vector<Position> positions;
    const auto record = [&](std::size_t bytes, int line, int column) {
        positions.insert(positions.end(), bytes, Position{line, column});
    };
    while (!walker.at_end() && positions.size() < result.text_.size()) {
        const int line = walker.line();
        const int column = walker.column();
        if (escapes && walker.peek() == '\\') {
            if (many_lines && escapes_line_end(walker)) {
                walker.step();
                while (walker.peek() == ' ' || walker.peek() == '\t' || walker.peek() == '\r' ||
                       walker.peek() == '\n')
                    walker.step();
            } else {
                record(step_over_escape(walker), line, column);
            }
        } else {
            // The TOML reader turns \r\n into \n.
            if (walker.sees("\r\n"))
                walker.step();
            walker.step();
            record(1, line, column);
        }
    }
    if (positions.size() != result.text_.size())
        return result;
    record(1, walker.line(), walker.column());
    result.positions_ = std::move(positions);
    return result;
}

Place SourceText::at(std::size_t offset) const {
    if (positions_.empty())
        return {.file = file_};
    const Position& position = positions_[std::min(offset, positions_.size() - 1)];
    return {.file = file_, .line = position.line, .column = position.column};
}

} // namespace tvbeam
