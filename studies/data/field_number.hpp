#pragma once

#include <optional>
#include <string_view>

namespace tvbeam {

/// Reads all of a text as a number: also with a plus, a decimal comma where the separator leaves
/// it, or a Fortran exponent. None where it is not one.
std::optional<double> number_of(std::string_view text, char separator);

} // namespace tvbeam
