#include "studies/data/printed_digits.hpp"

#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

/// With so many digits a number is the double that was printed.
constexpr int digits_of_a_double = std::numeric_limits<double>::digits10;

/// Where an exponent begins: behind a letter, or, of 1.5-103, at the sign. The end where there is
/// none.
std::size_t exponent_in(std::string_view text) {
    const auto at = text.find_first_of("eEdDqQ+-", 1);
    return std::min(at, text.size());
}

} // namespace

PrintedDigits printed_digits(std::string_view text) {
    const auto end = exponent_in(text);
    const auto mantissa = text.substr(0, end);
    PrintedDigits digits;
    bool is_behind_the_point = false;
    for (const char c : mantissa) {
        if (c == '.' || c == ',')
            is_behind_the_point = true;
        if (c < '0' || c > '9')
            continue;
        digits.significant += digits.significant > 0 || c != '0' ? 1 : 0;
        digits.last_place -= is_behind_the_point ? 1 : 0;
    }
    digits.is_zero = digits.significant == 0 && (digits.last_place == 0 || end < text.size());
    auto exponent = text.substr(end);
    exponent.remove_prefix(std::min(exponent.find_first_of("0123456789-"), exponent.size()));
    int places = 0;
    std::from_chars(exponent.data(), exponent.data() + exponent.size(), places);
    constexpr int beyond_doubles = 1000; // as of 0e-99999
    digits.last_place += std::clamp(places, -beyond_doubles, beyond_doubles);
    return digits;
}

std::vector<double> printed_units(const std::vector<double>& numbers,
                                  const std::vector<PrintedDigits>& digits) {
    int most = 0;
    int finest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (std::isfinite(numbers[i])) {
            most = std::max(most, digits[i].significant);
            finest = std::min(finest, digits[i].last_place);
        }
    // 0 is how any format prints a zero that is one; 0.00 is what is less than 0.005.
    const bool tells_nothing = most == 0 && finest >= 0;
    if (tells_nothing || most >= digits_of_a_double)
        return {};
    std::vector<double> units;
    units.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        // Of a fixed number of digits, the last place moves with the first.
        const int first = numbers[i] != 0 && std::isfinite(numbers[i])
                              ? digits[i].significant + digits[i].last_place
                              : finest;
        units.push_back(std::pow(10.0, std::max(finest, first - most)));
    }
    return units;
}

std::vector<double> printed_units_of_errors(const std::vector<double>& errors,
                                            const std::vector<PrintedDigits>& digits) {
    auto units = printed_units(errors, digits);
    for (std::size_t i = 0; i < units.size(); ++i)
        if (errors[i] == 0 && digits[i].is_zero)
            units[i] = 0;
    return units;
}

namespace {

/// What widths are refined by, where it is not a power: 2, 3, 4, 5, 5/2 and (k + 1)/k, as 1/h is
/// 10, 20, 30, 40 or 20, 50, 100.
bool is_of_a_refinement(double least, double most) {
    for (const double ratio : {2.0, 2.5, 3.0, 4.0, 5.0})
        if (least <= ratio && ratio <= most)
            return true;
    for (int k = 2; k <= 12; ++k)
        if (least <= (k + 1.0) / k && (k + 1.0) / k <= most)
            return true;
    return false;
}

} // namespace

std::vector<double> printed_units_of_widths(const std::vector<double>& widths,
                                            const std::vector<PrintedDigits>& digits) {
    const auto units = printed_units(widths, digits);
    if (units.empty())
        return {};
    if (std::ranges::all_of(widths, [](double width) { return std::floor(width) == width; }))
        return {};
    constexpr int greatest = 12;
    constexpr double rounding = 1e-12;
    const auto is_fraction = [](double ratio, double greatest_numerator) {
        for (int denominator = 1; denominator <= greatest; ++denominator) {
            const double numerator = ratio * denominator;
            if (std::abs(numerator - std::round(numerator)) <= rounding * numerator)
                return numerator < greatest_numerator + 0.5;
        }
        return false;
    };
    std::vector<std::pair<double, double>> sorted; // widths and halves of their units
    for (std::size_t i = 0; i < widths.size(); ++i)
        sorted.emplace_back(widths[i], units[i] / 2);
    std::ranges::sort(sorted, std::greater());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::size_t no_fractions = 0;
    bool all_exact = true;
    // One digit is a choice: a format has two.
    bool all_of_refinements =
        std::ranges::any_of(digits, [](const PrintedDigits& one) { return one.significant > 1; });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const auto& [coarse, half] = sorted[i - 1];
        const auto& [fine, its_half] = sorted[i];
        const double ratio = coarse / fine;
        no_fractions += is_fraction(ratio, 1 / rounding) ? 0 : 1;
        all_exact = all_exact && is_fraction(ratio, greatest);
        all_of_refinements =
            all_of_refinements && is_of_a_refinement((coarse - half) / (fine + its_half),
                                                     (coarse + half) / (fine - its_half));
    }
    return 2 * no_fractions > sorted.size() - 1 || (all_of_refinements && !all_exact)
               ? units
               : std::vector<double>();
}

std::vector<double> deviations_of_rounding(const std::vector<double>& errors,
                                           const std::vector<double>& units, double level_ratio,
                                           bool is_grid) {
    std::vector<double> relative;
    for (std::size_t i = 0; i < units.size(); ++i)
        if (errors[i] > 0 && std::isfinite(errors[i]))
            relative.push_back(units[i] / errors[i]);
    if (relative.empty())
        return {};
    const auto half = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::ranges::nth_element(relative, half);
    constexpr double of_four_digits = 1e-3;
    constexpr double of_five_digits = 1e-4;
    if (*half <=
        (is_grid ? of_five_digits : of_four_digits) * std::min(1.0, std::log2(level_ratio)))
        return {};
    // Of what is uniform over one unit of the last digit.
    std::vector<double> sigma(units.size());
    for (std::size_t i = 0; i < sigma.size(); ++i)
        sigma[i] = std::hypot(units[i], *half * errors[i]) / std::sqrt(12.0);
    return sigma;
}

double level_ratio(std::vector<double> widths) {
    const double one_level = OrderTuning{}.one_level;
    std::erase_if(widths, [](double width) { return !(width > 0) || !std::isfinite(width); });
    std::ranges::sort(widths);
    std::size_t levels = 0;
    double last = 0;
    for (const double width : widths)
        if (levels == 0 || width > one_level * last) {
            ++levels;
            last = width;
        }
    return levels < 2
               ? std::numeric_limits<double>::infinity()
               : std::pow(widths.back() / widths.front(), 1.0 / static_cast<double>(levels - 1));
}

} // namespace tvbeam
