#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// The shortest text with a power of ten that reads back as the same number.
std::string scientific_shortest(double value) {
    constexpr int most = 16;
    for (int decimals = 0; decimals < most; ++decimals)
        if (std::string text = scientific(value, decimals); number_in(text) == value)
            return text;
    return scientific(value, most);
}

/// Behind the point, of the shortest plain text that reads back as the same number.
int decimals_of(double value) {
    constexpr int most = 10;
    for (int decimals = 0; decimals < most; ++decimals)
        if (number_in(fmt::format("{:.{}f}", value, decimals)) == value)
            return decimals;
    return most;
}

} // namespace

std::string scientific(std::optional<double> value, int decimals) {
    if (!value)
        return {};
    if (*value == 0.0)
        return "0";
    if (std::isnan(*value)) // has no sign that means anything
        return "nan";
    return without_filling(fmt::format("{:.{}e}", *value, decimals));
}

std::string rounded_up(double value, int decimals) {
    const std::string text = scientific(value, decimals);
    constexpr double rounding = 1e-12; // of the value itself
    if (!(number_in(text) < value * (1.0 - rounding)) || !std::isfinite(value))
        return text;
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - decimals);
    return scientific(value + unit / 2.0, decimals);
}

double number_in(const std::string& text) {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::string without_numbers(const std::string& text) {
    std::string kind;
    for (const char c : text) {
        const bool digit = (c >= '0' && c <= '9') || c == '.';
        if (!digit)
            kind += c;
        else if (!kind.ends_with('#'))
            kind += '#';
    }
    return kind;
}

std::string shortest(double value) {
    if (std::isnan(value)) // has no sign that means anything
        return "nan";
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

std::vector<std::string> alike(const std::vector<double>& values) {
    constexpr std::size_t longest = 8;
    std::vector<std::string> plain;
    std::vector<std::string> powers;
    bool fits = true;
    for (const double value : values) {
        plain.push_back(fmt::format("{:.{}f}", value, decimals_of(value)));
        fits = fits && plain.back().size() <= longest && number_in(plain.back()) == value;
        powers.push_back(scientific_shortest(value));
    }
    return fits ? plain : powers;
}

int digits_within(double value, double half) {
    constexpr int fewest = 4, most = 17;
    if (!(half > 0) || value == 0)
        return 8;
    const double more = std::log10(std::abs(value) / half) + 3;
    return static_cast<int>(std::clamp(more, double{fewest}, double{most}));
}

std::string significant(double value, int digits) {
    if (std::isnan(value)) // has no sign that means anything
        return "nan";
    const std::string rounded = fmt::format("{:.{}e}", value, digits - 1);
    const int power = static_cast<int>(std::floor(std::log10(std::abs(number_in(rounded)))));
    if (value == 0.0 || power < -4 || power > 4)
        return value == 0.0 ? "0" : without_filling(rounded);
    return fmt::format("{:.{}f}", number_in(rounded), std::max(0, digits - 1 - power));
}

std::string fixed(std::optional<double> value, int decimals) {
    if (!value)
        return {};
    if (std::isnan(*value)) // has no sign that means anything
        return "nan";
    std::string text = fmt::format("{:.{}f}", *value, decimals);
    return number_in(text) == 0.0 ? fmt::format("{:.{}f}", 0.0, decimals) : text; // no "-0.00"
}

} // namespace tvbeam
