#pragma once

#include <string>

namespace tvbeam {

/// A number in a message, rounded to so many significant digits: 0.1, 1e-05, inf, nan.
std::string number_text(double value, int digits = 6);

} // namespace tvbeam
