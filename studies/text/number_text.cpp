#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

/// 1.5e-03 → 1.5e-3, 1e+02 → 1e2
std::string without_filling(std::string text) {
    const auto e = text.find('e');
    if (e == std::string::npos)
        return text;
    std::string exponent = text.substr(e + 1);
    const bool negative = exponent.starts_with('-');
    exponent.erase(0, std::min(exponent.find_first_not_of("+-0"), exponent.size()));
    text.erase(e);
    if (exponent.empty())
        return text;
    return text + (negative ? "e-" : "e") + exponent;
}

} // namespace

std::string scientific(std::optional<double> value, int decimals) {
    if (!value)
        return {};
    if (*value == 0.0)
        return "0";
    return without_filling(fmt::format("{:.{}e}", *value, decimals));
}

double number_in(const std::string& text) {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::string shortest(double value) {
    const std::string plain = without_filling(fmt::format("{}", value));
    const std::string exponent = without_filling(fmt::format("{:e}", value));
    // {:e} has six decimals; take it only when it says the same number in fewer characters.
    std::string trimmed = exponent;
    if (const auto e = exponent.find('e'); e != std::string::npos) {
        std::string mantissa = exponent.substr(0, e);
        mantissa.erase(mantissa.find_last_not_of('0') + 1);
        if (mantissa.ends_with('.'))
            mantissa.pop_back();
        trimmed = mantissa + exponent.substr(e);
    }
    return trimmed.size() < plain.size() && number_in(trimmed) == value ? trimmed : plain;
}

std::string with_prefix(double value) {
    // Rounded before the prefix is chosen: 999.7e-6 is 1.00m. The parts allow for 1e-3 not being a
    // thousandth exactly.
    const double rounded = number_in(fmt::format("{:.2e}", value));
    for (const auto& [unit, prefix] : {std::pair{1.0, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}) {
        const double part = rounded / unit;
        if (part >= 1.0 - 1e-9)
            return fixed(part, part < 9.999 ? 2 : part < 99.99 ? 1 : 0) + prefix;
    }
    return scientific(value, 2);
}

std::string fixed(std::optional<double> value, int decimals) {
    if (!value)
        return {};
    return fmt::format("{:.{}f}", *value, decimals);
}

} // namespace tvbeam
