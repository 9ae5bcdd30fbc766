#pragma once

#include <string>

namespace tvbeam {

/// A number in a message, rounded to so many significant digits: 0.1, 1e-05, inf, nan.
std::string number_text(double value, int digits = 6);

/// A number with the fewest digits that read back as the same double.
std::string exact_text(double value);

/// A number that is said to lie on one side of a limit, with as many digits, 6 at least, as it
/// takes to see that.
std::string number_text_beside(double value, double limit);

} // namespace tvbeam
