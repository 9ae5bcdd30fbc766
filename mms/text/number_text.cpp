#include "mms/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

std::string number_text(double value, int digits) {
    return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

std::string exact_text(double value) {
    return std::isnan(value) ? "nan" : fmt::format("{}", value);
}

std::string number_text_beside(double value, double limit) {
    constexpr int fewest = 6;
    constexpr int all = 17; // which no two doubles share
    int digits = fewest;
    while (digits < all && value != limit &&
           number_text(value, digits) == number_text(limit, digits))
        ++digits;
    return number_text(value, digits);
}

} // namespace tvbeam
