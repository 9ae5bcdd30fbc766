#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tvbeam {

/// The text with everything that a terminal would obey written out: control characters other than
/// the line end and the tabulator, as \x1B or \u009B, and bytes that are no UTF-8. What is left
/// may stand in XML, too.
std::string visible(const std::string& text);

/// What the text begins with, in at most so many bytes, and no part of a character at the end.
std::string_view whole_characters(std::string_view text, std::size_t most);

/// The code of a character, where there is no other way to show it: "U+6F22".
std::string code_text(const std::string& character);

} // namespace tvbeam
