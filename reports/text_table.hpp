#pragma once

#include "reports/table.hpp"

#include <string>

namespace tvbeam {

/// A table for a terminal: a blank between the columns. Where the groups do not fit into the width
/// together, the table is continued below, its key columns repeated; a single group wider than
/// `width` is kept whole. Lines, each ending in a newline, none with blanks at its end.
std::string text_table(const Table& table, std::size_t width = 80);

/// Breaks text at blanks into lines of at most `width` characters, the later ones indented.
std::string wrapped(const std::string& text, std::size_t indent = 2, std::size_t width = 80);

} // namespace tvbeam
