#include "studies/orders/value_steps.hpp"

#include "studies/orders/observed_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tvbeam {

namespace {

/// Is the finest step more than what the known deviations make of no step at all?
bool is_significant(const ValueRow& coarse, const ValueRow& fine) {
    constexpr double deviations = 3;
    const double sigma = std::hypot(fine.sigma, coarse.sigma);
    return !(std::abs(fine.value - coarse.value) <= deviations * sigma);
}

/// The steps between levels, each over the logarithm of its ratio.
std::vector<double> steps_of(const ValueLevels& levels) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < levels.size(); ++i)
        steps.push_back((levels[i].value - levels[i - 1].value) /
                        std::log(levels[i - 1].h / levels[i].h));
    return steps;
}

constexpr double equal_steps = 1 - 1e-6; // those of ln h are, but for rounding

} // namespace

bool alternates(const ValueLevels& levels) {
    const std::size_t n = levels.size();
    const auto step = [&](std::size_t back) {
        return levels[n - back].value - levels[n - back - 1].value;
    };
    return step(1) * step(2) < 0 && (n < 4 || step(2) * step(3) < 0);
}

bool is_erratic(const ValueLevels& levels) {
    std::vector<double> ratios;
    for (std::size_t i = 2; i < levels.size(); ++i)
        ratios.push_back((levels[i].value - levels[i - 1].value) /
                         (levels[i - 1].value - levels[i - 2].value));
    return ratios.size() >= 3 && (!std::is_sorted(ratios.begin(), ratios.end()) &&
                                  !std::is_sorted(ratios.rbegin(), ratios.rend()));
}

bool is_significant(const ValueLevels& levels) {
    return is_significant(levels[levels.size() - 2], levels.back());
}

bool goes_further_than_digits(const ValueLevels& levels) {
    constexpr double units = 4;
    const double unit = levels.back().unit;
    return unit > 0 && levels.front().sigma <= unit && levels.back().sigma <= unit &&
           std::abs(levels.back().value - levels.front().value) >= units * unit;
}

bool runs_apart_in_the_end(const ValueLevels& levels) {
    const auto steps = steps_of(levels);
    constexpr double growing = 4;
    constexpr double rounding = 1 + 1e-9;
    std::size_t first = steps.size() - 1;
    double ratio = levels[first].h / levels[first + 1].h; // the greatest
    while (first > 0 && steps[first - 1] * steps[first] > 0 &&
           equal_steps * std::abs(steps[first - 1]) <= std::abs(steps[first]) &&
           is_significant(levels[first - 1], levels[first])) {
        --first;
        ratio = std::max(ratio, levels[first].h / levels[first + 1].h);
    }
    return levels[first].h > growing * ratio * rounding * levels[steps.size() - 1].h;
}

bool steps_grow(const ValueLevels& levels) {
    std::vector<double> steps = steps_of(levels);
    const bool to_and_fro = steps[0] * steps[1] < 0;
    for (std::size_t i = 1; i < steps.size(); ++i)
        if ((steps[i] * steps[i - 1] < 0) != to_and_fro)
            return false;
    for (auto& step : steps)
        step = std::abs(step);
    const std::size_t last = steps.size() - 1;
    for (std::size_t i = 0; i < last; ++i)
        if (steps[last] < equal_steps * steps[i] ||
            (i + 2 >= last && steps[i + 1] < equal_steps * steps[i]))
            return false;
    return steps[last] >
           roundings * std::numeric_limits<double>::epsilon() * std::abs(levels.back().value);
}

std::size_t standing_still(const ValueLevels& levels, double rounding) {
    const auto& finest = levels.back();
    const auto is_same = [&](const ValueRow& row) {
        return std::abs(row.value - finest.value) <= std::max(rounding, finest.unit / 2);
    };
    std::size_t first = levels.size() - 1; // of those that are one
    while (first > 0 && is_same(levels[first - 1]))
        --first;
    const std::size_t count = levels.size() - first;
    constexpr std::size_t fewest = 3; // of two every window has a step
    if (count < fewest || first == 0)
        return 0;
    constexpr double deviations = 3;
    const double scatter = is_positive(finest.sigma) ? deviations * finest.sigma : 0.0;
    const double resolution = std::max({rounding, finest.unit, scatter});
    const double last = std::abs(levels[first].value - levels[first - 1].value);
    const double ratio = levels[first - 1].h / levels[first].h;
    if (first == 1)
        return last > resolution * std::pow(ratio, greatest_order) ? count : 0;
    const double before = std::abs(levels[first - 1].value - levels[first - 2].value);
    const double shrinks = before > last ? last / before : 1.0;
    const double next = last * std::pow(shrinks, first < 3 ? 1.0 : std::max(2.0, ratio));
    constexpr double of_steps = 3; // rounding moves each step by one
    return next > of_steps * resolution ? count : 0;
}

} // namespace tvbeam
