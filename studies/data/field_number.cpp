#include "studies/data/field_number.hpp"

#include <charconv>
#include <limits>
#include <string>
#include <system_error>

namespace tvbeam {

std::optional<double> number_of(std::string_view text, char separator) {
    if (text.starts_with('+') && text.size() > 1 && text[1] != '-' && text[1] != '+')
        text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size())
        return value;
    constexpr std::size_t longest = 64;
    if (text.empty() || text.size() > longest ||
        text.find_first_not_of("0123456789+-.,eEdDqQ") != std::string_view::npos)
        return std::nullopt;
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool after_digit =
            i > 0 && std::string_view("0123456789.").find(text[i - 1]) != std::string_view::npos;
        if (c == ',' && separator == ';')
            plain += '.';
        else if (std::string_view("dDqQE").find(c) != std::string_view::npos)
            plain += 'e';
        else if ((c == '+' || c == '-') && after_digit)
            plain += std::string("e") + c; // 1.5-103
        else
            plain += c;
    }
    if (const auto plus = plain.find("e+"); plus != std::string::npos)
        plain.erase(plus + 1, 1);
    long double wide = 0;
    const auto [wide_end, wide_error] =
        std::from_chars(plain.data(), plain.data() + plain.size(), wide);
    if (wide_end != plain.data() + plain.size() || wide_error == std::errc::invalid_argument)
        return std::nullopt;
    if (wide_error == std::errc::result_out_of_range)
        return plain.find("e-") != std::string::npos ? 0.0 : std::numeric_limits<double>::max() * 2;
    return static_cast<double>(wide);
}

} // namespace tvbeam
