#pragma once

#include <string>
#include <string_view>

namespace tvbeam {

// What other languages, and people with a pencil, write otherwise than expressions do: each says
// how it is written here, e.g. "; the natural logarithm is log(…)". Empty: nothing is known of it.

/// Of a name with a bracket behind it.
std::string advice_on_function(std::string_view name);

/// Of a name without.
std::string advice_on_symbol(std::string_view name);

/// Of the text from the character on that is not expected.
std::string advice_on_character(std::string_view rest);

} // namespace tvbeam
