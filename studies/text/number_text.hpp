#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// 1.2455e-3: mantissa with the given decimals, exponent without filling zeros; nothing for a
/// missing value.
std::string scientific(std::optional<double> value, int decimals);

/// The same of a bound from above: rounded away from zero, > 0.
std::string rounded_up(double value, int decimals);

/// The number that a text begins with, whatever the locale; NaN where there is none or it is beyond
/// the doubles.
double number_in(const std::string& text);

/// A text with # for every number, to count those alike.
std::string without_numbers(const std::string& text);

/// The shortest of plain and scientific notation that reads back as the same double.
std::string shortest(double value);

/// The shortest, all in plain notation or, where that takes more than eight characters, all in
/// scientific.
std::vector<std::string> alike(const std::vector<double>& values);

/// So many digits of a number that an interval of this half-width shows two of its own: 4 to 17.
int digits_within(double value, double half);

/// So many significant digits: 190, 0.031; below 1e-4 and from 1e5 on scientific.
std::string significant(double value, int digits);

/// Fixed notation, without the sign of what is rounded to zero; nothing for a missing value.
std::string fixed(std::optional<double> value, int decimals);

} // namespace tvbeam
