#include "mms/admissible/repair.hpp"

#include "mms/expression/printing.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

constexpr std::size_t longest_formula = 80;

/// Rounds to four significant digits by the rounding given.
double four_digits(double value, double (*rounding)(double)) {
    if (value == 0.0 || !std::isfinite(value))
        return value;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
    return std::copysign(rounding(std::abs(value) / unit) * unit, value);
}

} // namespace

std::string subtraction(const GiNaC::ex& excess, const std::string& name, const std::string& from) {
    const std::string text = formula_text(excess);
    if (text.size() > longest_formula)
        return "subtract " + name + " from " + from;
    if (text.front() == '-')
        return "add " + formula_text(-excess) + " to " + from;
    return "subtract " + text + " from " + from;
}

// A number of four digits or fewer stays as it is, whatever its binary form.
constexpr double rounding_slack = 1e-9;

double rounded_in(double value) {
    return four_digits(value, [](double digits) { return std::floor(digits + rounding_slack); });
}

double rounded_out(double value) {
    return four_digits(value, [](double digits) { return std::ceil(digits - rounding_slack); });
}

double switch_time(const std::function<bool(double t)>& state, double begin, double end) {
    const bool first = state(begin);
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (begin + end);
        (state(middle) == first ? begin : end) = middle;
    }
    return 0.5 * (begin + end);
}

std::optional<std::string> meeting_time(const std::function<double(double t)>& distance,
                                        double begin, double end, double tolerance) {
    constexpr int samples = 256;
    const double width = (end - begin) / samples;
    double nearest = begin;
    double least = distance(begin);
    for (int i = 1; i <= samples; ++i) {
        const double t = begin + width * i;
        if (const double here = distance(t); here < least) {
            nearest = t;
            least = here;
        }
    }
    // A ternary search: near its zero a distance falls and rises again.
    double left = std::max(begin, nearest - width);
    double right = std::min(end, nearest + width);
    constexpr int thirds = 100;
    for (int i = 0; i < thirds; ++i) {
        const double third = (right - left) / 3.0;
        if (distance(left + third) < distance(right - third))
            right -= third;
        else
            left += third;
    }
    constexpr int fewest_digits = 6;
    for (int digits = fewest_digits; digits <= std::numeric_limits<double>::max_digits10;
         ++digits) {
        const std::string text = number_text(0.5 * (left + right), digits);
        double written = 0.0;
        std::from_chars(text.data(), text.data() + text.size(), written);
        if (written > begin && distance(written) <= tolerance)
            return text;
    }
    return std::nullopt;
}

} // namespace tvbeam
