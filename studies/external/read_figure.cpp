#include "studies/external/read_figure.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace tvbeam {

std::string without_blanks(const std::string& text) {
    constexpr const char* blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    return first == std::string::npos
               ? ""
               : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

ReadFigure figure_of(const std::string& name, const std::string& written) {
    std::string text = without_blanks(written);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c == 'd' || c == 'D' ? 'e' : c; });
    if (text.starts_with('+'))
        text.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument)
        return {{}, name + " is '" + without_blanks(written) + "', which is not one number"};
    if (error == std::errc::result_out_of_range)
        return {{}, name + " is " + without_blanks(written) + ", beyond the range of doubles"};
    if (!std::isfinite(value))
        return {{}, name + " is " + without_blanks(written)};
    return {value, {}, printed_digits(text)};
}

} // namespace tvbeam
