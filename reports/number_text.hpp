#pragma once

#include <optional>
#include <string>

namespace tvbeam {

/// 1.2455e-3: mantissa with the given decimals, exponent without filling zeros; nothing for a
/// missing value.
std::string scientific(std::optional<double> value, int decimals);

/// The shortest of plain and scientific notation that reads back as the same double.
std::string shortest(double value);

/// Fixed notation; nothing for a missing value.
std::string fixed(std::optional<double> value, int decimals);

} // namespace tvbeam
