#include "mms/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

std::string number_text(double value, int digits) {
    return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

} // namespace tvbeam
