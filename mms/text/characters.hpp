#pragma once

#include <string_view>

namespace tvbeam {

/// What some programs begin a file in UTF-8 with; it is no part of the text.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Of ASCII, whatever the locale.

inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

} // namespace tvbeam
