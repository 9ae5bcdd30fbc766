#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// A table for a terminal: right-aligned columns, a blank between them. Columns of a group stay
/// side by side; where the groups do not fit into the width together, the table is continued below,
/// its key columns repeated.
class TextTable {
public:
    struct Column {
        std::string heading;
        std::vector<std::string> cells; ///< one a row
    };
    struct Group {
        std::string heading; ///< stands above the group's columns; may be empty
        std::vector<Column> columns;
    };

    TextTable(Group key, std::vector<Group> groups);

    /// Lines, each ending in a newline, none with blanks at its end. A single group wider than
    /// `width` is kept whole.
    [[nodiscard]] std::string text(std::size_t width = 80) const;

private:
    Group key_;
    std::vector<Group> groups_;
};

/// Breaks text at blanks into lines of at most `width` characters, the later ones indented.
std::string wrapped(const std::string& text, std::size_t indent = 2, std::size_t width = 80);

} // namespace tvbeam
