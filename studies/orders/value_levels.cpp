#include "studies/orders/value_levels.hpp"

#include "studies/orders/observed_order.hpp"
#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tvbeam {

ValueLevels value_levels(std::span<const ValueRow> given) {
    constexpr std::size_t most_levels = 48; // less than the designs of fit_at hold
    ValueLevels rows;
    for (const auto& row : given)
        if (is_positive(row.h) && std::isfinite(row.value))
            rows.push_back(row);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& left, const auto& right) { return left.h > right.h; });
    std::size_t widths = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        widths += i == 0 || rows[i].h < rows[i - 1].h ? 1 : 0;
    const double cell =
        widths > most_levels ? std::log(rows.front().h / rows.back().h) / (most_levels - 1) : 0.0;
    ValueLevels levels;
    std::vector<double> counts;
    double squares = 0;
    for (std::size_t i = 0, next = 0; i < rows.size(); i = next) {
        ValueRow mean{0, 0, 0, 0};
        double square = 0;
        for (next = i; next < rows.size() && rows[next].h >= rows[i].h * std::exp(-cell); ++next) {
            const double off = rows[next].value - rows[i].value;
            mean.h += rows[next].h;
            mean.value += off;
            mean.sigma += rows[next].sigma * rows[next].sigma;
            mean.unit = std::max(mean.unit, rows[next].unit);
            square += off * off;
        }
        const auto n = counts.emplace_back(static_cast<double>(next - i));
        squares += square - mean.value * mean.value / n;
        levels.push_back(
            {mean.h / n, rows[i].value + mean.value / n, std::sqrt(mean.sigma) / n, mean.unit});
    }
    const auto dof = static_cast<int>(rows.size() - levels.size());
    const double pooled = std::sqrt(squares / dof) * student_over_normal(dof);
    for (std::size_t i = 0; i < levels.size() && dof > 0 && cell == 0; ++i)
        if (std::isnan(levels[i].sigma))
            levels[i].sigma = pooled / std::sqrt(counts[i]);
    return levels;
}

std::optional<double> coarsely_printed_step(const ValueLevels& levels, double exact) {
    const auto& fine = levels.back();
    const auto& coarse = levels[levels.size() - 2];
    const double step = std::abs(fine.value - coarse.value) / std::max(fine.unit, coarse.unit);
    return step < exact ? std::optional(step) : std::nullopt;
}

void add_rounding(ValueLevels& levels) {
    const double uniform = 1 / std::sqrt(12.0); // the deviation of what is spread over one unit
    for (auto& level : levels)
        level.sigma = std::isnan(level.sigma) ? uniform * level.unit
                                              : std::max(level.sigma, uniform * level.unit);
}

double hidden_by_digits(const ValueLevels& levels) {
    return levels.back().unit * (0.5 + 1 / (levels.front().h / levels.back().h - 1));
}

bool has_three_widths(const ValueLevels& levels) {
    constexpr double least_ratio = 1.05;
    int widths = 1;
    double coarser = levels.front().h;
    for (const auto& level : levels)
        if (coarser >= least_ratio * level.h) {
            ++widths;
            coarser = level.h;
        }
    return widths >= 3 && levels.front().h >= OrderTuning{}.one_level * levels.back().h;
}

ScaledLevels scaled(const ValueLevels& levels) {
    ScaledLevels result{levels, levels.back().value};
    for (auto& row : result.levels) {
        row.value -= result.origin;
        result.scale = std::max(result.scale, std::abs(row.value));
    }
    if (result.scale > 0)
        for (auto& row : result.levels) {
            row.value /= result.scale;
            row.sigma /= result.scale;
            row.unit /= result.scale;
        }
    return result;
}

std::size_t last_turn(const ValueLevels& levels) {
    std::size_t last = 0;
    for (std::size_t k = 1; k + 1 < levels.size(); ++k)
        if ((levels[k].value - levels[k - 1].value) * (levels[k + 1].value - levels[k].value) < 0)
            last = k;
    return last;
}

ValueLevels past_the_turn(const ValueLevels& levels) {
    const std::size_t first = last_turn(levels);
    return levels.size() - first < fewest_past_a_turn
               ? levels
               : ValueLevels(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end());
}

} // namespace tvbeam
