#pragma once

#include "mms/text/input_error.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// Where in a text a line and column are, without reading all that stands before.
class LineIndex {
public:
    /// Knows only where the text begins.
    LineIndex() = default;
    explicit LineIndex(std::string_view text);

    struct Mark {
        std::size_t offset;
        int line;
        int column; ///< in code points, as editors count
    };

    /// A place before the one asked for, at most 4 kB, or where the text begins.
    [[nodiscard]] Mark before(int line, int column) const;

private:
    std::vector<Mark> marks_;
};

/// A text and the place of each of its characters in the file it was read from.
class SourceText {
public:
    SourceText() = default;

    /// A text that stands on one line, its first character at `first`. Columns count code points,
    /// as editors do.
    SourceText(std::string text, const Place& first);

    /// A string of a TOML document, of any of TOML's four kinds, with or without escapes.
    /// @param value    the string as the TOML reader understood it
    /// @param document the whole TOML document
    /// @param opening  where its opening quote stands in the document, as the TOML reader says
    /// @param lines    of the document; without it, all that stands before the string is read
    static SourceText of_toml_string(std::string value, std::string_view document,
                                     const Place& opening, const LineIndex& lines = {});

    [[nodiscard]] const std::string& text() const { return text_; }

    /// Where the byte `offset` of the text stands; an offset at or past the end gives the place
    /// after the text.
    [[nodiscard]] Place at(std::size_t offset) const;

    /// Where the text begins.
    [[nodiscard]] Place begin() const { return at(0); }

private:
    struct Position {
        int line;
        int column;
    };

    std::string text_;
    std::string file_;
    std::vector<Position> positions_; ///< one for each byte of the text, and one for its end
};

} // namespace tvbeam
