#pragma once

#include <string>

namespace tvbeam {

/// The text with everything that a terminal would obey written out: control characters other than
/// the line end and the tabulator, as \x1B or \u009B, and bytes that are no UTF-8. What is left
/// may stand in XML, too.
std::string visible(const std::string& text);

} // namespace tvbeam
