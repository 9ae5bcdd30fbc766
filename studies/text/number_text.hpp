#pragma once

#include <optional>
#include <string>

namespace tvbeam {

/// 1.2455e-3: mantissa with the given decimals, exponent without filling zeros; nothing for a
/// missing value.
std::string scientific(std::optional<double> value, int decimals);

/// The number that a text begins with, whatever the locale; NaN where there is none or it is beyond
/// the doubles.
double number_in(const std::string& text);

/// The shortest of plain and scientific notation that reads back as the same double.
std::string shortest(double value);

/// Three significant digits and an SI prefix: 11.5µ for 1.15e-5, 278m for 0.278, 2.31; below 1n,
/// scientific.
std::string with_prefix(double value);

/// Fixed notation; nothing for a missing value.
std::string fixed(std::optional<double> value, int decimals);

} // namespace tvbeam
