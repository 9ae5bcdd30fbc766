#include "mms/admissible/repair.hpp"

#include "mms/expression/printing.hpp"
#include "mms/text/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t longest_offered = 80;

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
    if (text.size() > longest_offered)
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

namespace {

/// Where a distance that falls and rises again in [left, right] is least: a ternary search.
double least_between(const std::function<double(double t)>& distance, double left, double right) {
    constexpr int thirds = 100;
    for (int i = 0; i < thirds; ++i) {
        const double third = (right - left) / 3.0;
        if (distance(left + third) < distance(right - third))
            right -= third;
        else
            left += third;
    }
    return 0.5 * (left + right);
}

} // namespace

std::optional<std::string> meeting_time(const std::function<double(double t)>& distance,
                                        double begin, double end, double wanted, double tolerance) {
    constexpr int samples = 256;
    constexpr int fewest_digits = 6;
    const auto at = [&](int i) { return begin + (end - begin) * i / samples; };
    std::vector<double> distances;
    for (int i = 0; i <= samples; ++i)
        distances.push_back(distance(at(i)));
    std::optional<std::string> nearest;
    double off = std::numeric_limits<double>::infinity();
    // Both phases may be the same where the first begins, which is no place to end it.
    for (int i = 1; i <= samples; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!(distances[k] <= distances[k - 1] &&
              (i == samples || distances[k] <= distances[k + 1])))
            continue;
        const double least = least_between(distance, at(i - 1), std::min(at(i + 1), end));
        for (int digits = fewest_digits; digits <= std::numeric_limits<double>::max_digits10;
             ++digits) {
            const std::string text = number_text(least, digits);
            double written = 0.0;
            std::from_chars(text.data(), text.data() + text.size(), written);
            if (!(written > begin && written <= end && distance(written) <= tolerance))
                continue;
            if (std::abs(written - wanted) < off) {
                off = std::abs(written - wanted);
                nearest = text;
            }
            break;
        }
    }
    return nearest;
}

} // namespace tvbeam
