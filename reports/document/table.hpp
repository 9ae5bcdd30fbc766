#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// A table as it was worked out, whatever it is written as: text for a terminal (text_table.hpp),
/// Markdown, LaTeX or HTML. A cell is the text that a terminal shows: "1.2455e-3", "failed", "".
/// Columns are right-aligned; those of a group belong side by side.
struct Table {
    struct Column {
        std::string heading;
        std::vector<std::string> cells; ///< one a row
    };
    struct Group {
        std::string heading; ///< stands above the group's columns; may be empty
        std::vector<Column> columns;
    };

    std::string caption; ///< for formats in which a table stands by itself; terminals omit it
    Group key;           ///< the first columns, which say what a row is; at least one
    std::vector<Group> groups;

    [[nodiscard]] std::size_t rows() const { return key.columns.front().cells.size(); }
};

} // namespace tvbeam
