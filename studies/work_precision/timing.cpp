#include "studies/work_precision/timing.hpp"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

namespace tvbeam {

namespace {

/// Below this, a difference is as likely the machine's as the scheme's.
constexpr double least_time_ratio = 1.2;
/// The same of single runs, whose scatter is not known.
constexpr double least_ratio_of_one_run = 2.0;
/// Of a lower quartile: a step of the clock that is worth a word.
constexpr double least_part_of_a_step = 0.01;

bool has_error(const TimedError& row) {
    return std::isfinite(row.error) && row.error > 0.0;
}

/// Whether two errors are the same as far as times depend on them.
bool same(double first, double second) {
    return std::abs(first - second) <= same_error * second;
}

/// Between the rows a and b: at a for weight 0, at b for weight 1.
Timing between(const Timing& a, const Timing& b, double weight) {
    const auto at = [&](double Timing::*value) {
        return std::exp((1.0 - weight) * std::log(a.*value) + weight * std::log(b.*value));
    };
    const double median = at(&Timing::median);
    return {.min = at(&Timing::min),
            .q1 = at(&Timing::q1),
            .median = median,
            .q3 = at(&Timing::q3),
            .runs = std::min(a.runs, b.runs),
            .clock_step = median * ((1.0 - weight) * a.clock_step / a.median +
                                    weight * b.clock_step / b.median)};
}

/// At an error between those of two rows, the first of which exceeds it.
std::optional<Timing> time_between(const TimedError& before, const TimedError& after,
                                   double error) {
    if (&after - &before > 1) { // rows without error between them
        if (same(before.error, error))
            return before.timing;
        return same(after.error, error) ? std::optional(after.timing) : std::nullopt;
    }
    const double weight = std::log(before.error / error) / std::log(before.error / after.error);
    return between(before.timing, after.timing, weight);
}

} // namespace

Timing timing_of(std::vector<double> seconds, double clock_step) {
    std::sort(seconds.begin(), seconds.end());
    const auto quantile = [&](double fraction) {
        return gsl_stats_quantile_from_sorted_data(seconds.data(), 1, seconds.size(), fraction);
    };
    return {.min = seconds.front(),
            .q1 = quantile(0.25),
            .median = quantile(0.5),
            .q3 = quantile(0.75),
            .runs = static_cast<int>(seconds.size()),
            .clock_step = clock_step,
            .at_zero = static_cast<int>(std::ranges::count(seconds, 0.0))};
}

double clock_step_of(const std::vector<double>& seconds, double printed_unit) {
    constexpr int most_decimals = 6;
    constexpr double by_chance = 1e-3;
    constexpr double rounding = 1e-6; // of a step, in what was read
    const auto are_whole = [&](double steps_a_second, double slack) {
        return std::ranges::all_of(seconds, [&](double time) {
            const double steps = time * steps_a_second;
            // What is shorter than a step is no whole one, however far it may be rounded.
            return std::abs(steps - std::round(steps)) <= slack &&
                   (time == 0.0 || std::round(steps) >= 1.0);
        });
    };
    std::set<double> shown(seconds.begin(), seconds.end());
    shown.erase(0.0);
    const auto is_by_chance = [&](double part) {
        return !(std::pow(part, static_cast<double>(shown.size())) <= by_chance);
    };
    double printed = printed_unit;
    for (int decimals = 0; decimals <= most_decimals; ++decimals) {
        const double steps_a_second = std::pow(10.0, decimals);
        if (printed_unit * steps_a_second < 1.0 && are_whole(steps_a_second, rounding) &&
            !is_by_chance(printed_unit * steps_a_second)) {
            printed = 1.0 / steps_a_second;
            break;
        }
    }
    // Ticks a second of operating systems' clocks. Printed, they are rounded, and other times may
    // be whole ticks by chance, a part 2 slack of them.
    for (const double ticks : {60.0, 64.0, 128.0, 250.0, 256.0, 300.0, 1024.0}) {
        const double slack = rounding + printed * ticks / 2.0;
        if (!are_whole(ticks, slack) || is_by_chance(2.0 * slack))
            continue;
        std::int64_t common = 0; // what has more ticks in each has a greater step
        for (const double time : shown)
            common = std::gcd(common, std::llround(time * ticks));
        if (common == 1)
            return 1.0 / ticks;
    }
    return printed;
}

std::optional<Timing> time_to_reach(std::span<const TimedError> rows, double error) {
    const auto last = std::find_if(rows.rbegin(), rows.rend(), has_error);
    const auto first = std::find_if(rows.begin(), rows.end(), has_error);
    if (first == rows.end())
        return std::nullopt;
    // The finest row that exceeds the error; from the next one on it is reached.
    const auto above = std::find_if(rows.rbegin(), rows.rend(), [&](const TimedError& row) {
        return has_error(row) && row.error > error;
    });
    std::optional<Timing> reached;
    if (above == last)
        return same(last->error, error) ? std::optional(last->timing) : std::nullopt;
    if (above == rows.rend())
        reached = same(first->error, error) ? std::optional(first->timing) : std::nullopt;
    else
        reached = time_between(*above, *std::find_if(above.base(), rows.end(), has_error), error);
    // A finer row may be cheaper, as where a solver takes fewer iterations on it.
    for (auto row = above.base(); reached && row != rows.end(); ++row)
        if (has_error(*row) && row->timing.median < reached->median)
            reached = row->timing;
    return reached;
}

Comparison compare(const Timing& first, const Timing& second) {
    constexpr double rounding = 1e-9;
    Comparison result;
    result.first_is_faster = first.median < second.median;
    const Timing& fast = result.first_is_faster ? first : second;
    const Timing& slow = result.first_is_faster ? second : first;
    result.ratio = slow.median / fast.median;
    result.lowest = std::max(slow.q1 - slow.clock_step, 0.0) / (fast.q3 + fast.clock_step);
    if (std::abs(result.lowest - 1.0) < rounding)
        result.lowest = 1.0; // two steps of the clock apart: they touch
    result.highest = (slow.q3 + slow.clock_step) / std::max(fast.q1 - fast.clock_step, 0.0);
    const Timing& coarse = slow.clock_step * fast.q1 > fast.clock_step * slow.q1 ? slow : fast;
    if (coarse.clock_step > least_part_of_a_step * coarse.q1)
        result.clock_step = coarse.clock_step;
    const bool once = first.runs == 1 || second.runs == 1;
    result.distinguishable =
        result.ratio > (once ? least_ratio_of_one_run : least_time_ratio) && result.lowest > 1.0;
    return result;
}

} // namespace tvbeam
