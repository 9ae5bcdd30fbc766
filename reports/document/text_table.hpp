#pragma once

#include "reports/document/table.hpp"

#include <string>

namespace tvbeam {

/// The table in parts of at most `width` characters, a blank between the columns: groups that do
/// not fit beside those before them go to the next part, which repeats the key columns. A single
/// group that is wider is kept whole.
std::vector<Table> parts_of(const Table& table, std::size_t width);

/// A table for a terminal: its parts, one below the other. Lines, each ending in a newline, none
/// with blanks at its end.
std::string text_table(const Table& table, std::size_t width = 80);

/// Breaks text at blanks into lines of at most `width` characters, the later ones indented; blanks
/// within a line stay as many as they are.
std::string wrapped(const std::string& text, std::size_t indent = 2, std::size_t width = 80);

} // namespace tvbeam
