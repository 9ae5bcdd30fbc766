#pragma once

#include "studies/data/printed_digits.hpp"

#include <optional>
#include <string>

namespace tvbeam {

/// A number that was read, or why there is none.
struct ReadFigure {
    std::optional<double> value; ///< finite
    std::string failure;         ///< e.g. "L2 is nan"
    PrintedDigits printed = {};
};

/// The text without blanks on either side.
std::string without_blanks(const std::string& text);

/// The whole text as one number, also with the exponent of Fortran; name: of the number.
ReadFigure figure_of(const std::string& name, const std::string& written);

} // namespace tvbeam
