#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/text/number_text.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// Whether a run can stand on the axes: a clock may show no time at all.
bool is_drawn(const RungResult& run, const Timing& timing, std::size_t k) {
    return timing.q1 > 0.0 && !run.errors.empty() && run.errors[k] > 0.0;
}

/// The rows of a scheme that were timed and can be drawn.
std::string rows_of(const SchemeRuns& scheme, std::size_t k) {
    std::string rows;
    for (std::size_t i = 0; i < scheme.runs.size(); ++i) {
        const RungResult& run = scheme.runs[i];
        if (const auto& timing = scheme.timings[i]; timing && is_drawn(run, *timing, k))
            rows += fmt::format("{} {} {} {} {} {}\n", timing->median, run.errors[k], timing->q1,
                                timing->q3, run.rung.elements, run.rung.dt);
    }
    return rows;
}

/// Whether the clock has hidden a run.
bool has_zero_time(const WorkPrecisionResult& result) {
    return std::any_of(result.schemes.begin(), result.schemes.end(), [](const auto& scheme) {
        return std::any_of(scheme.timings.begin(), scheme.timings.end(),
                           [](const auto& timing) { return timing && !(timing->q1 > 0.0); });
    });
}

/// The axes end a little beyond what is drawn: an error to reach that is far away would press the
/// runs together.
void set_ranges(Drawing& drawing, const WorkPrecisionResult& result, std::size_t k) {
    std::vector<double> seconds;
    std::vector<double> errors;
    for (const auto& scheme : result.schemes)
        for (std::size_t i = 0; i < scheme.runs.size(); ++i)
            if (const auto& timing = scheme.timings[i];
                timing && is_drawn(scheme.runs[i], *timing, k)) {
                seconds.insert(seconds.end(), {timing->q1, timing->median, timing->q3});
                errors.push_back(scheme.runs[i].errors[k]);
            }
    const auto around = [](const std::vector<double>& numbers) {
        const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
        const double room = std::max(1.2, std::pow(*greatest / *least, 0.08));
        return std::pair(*least / room, *greatest * room);
    };
    drawing.x.range = around(seconds);
    drawing.y.range = around(errors);
}

std::vector<double> within(const std::vector<double>& numbers,
                           const std::pair<double, double>& range) {
    std::vector<double> inside;
    std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(inside),
                 [&](double number) { return range.first < number && number < range.second; });
    return inside;
}

/// None where no row can be drawn.
std::vector<Plot> plot_of(const WorkPrecisionResult& result, const WorkPrecisionBlock& block,
                          std::size_t k) {
    const Measure& norm = block.norms[k];
    Drawing drawing;
    for (std::size_t j = 0; j < block.schemes.size(); ++j) {
        const std::string rows = rows_of(result.schemes[j], k);
        if (rows.empty())
            continue;
        const std::size_t data = drawing.add_block(
            block.schemes[j].name +
                ": median of the seconds, error, lower quartile, upper quartile, elements, dt",
            rows);
        drawing.add_curve({.block = data, .third = 3, .fourth = 4},
                          look_of(series_style(j), CurveLook::Kind::bars), block.schemes[j].name);
    }
    if (drawing.is_empty())
        return {};
    const std::string name = "run_time_" + norm.name;
    drawing.x = {.title = "run time in seconds, median and quartiles", .is_logarithmic = true};
    drawing.y = {.title = norm.squared ? "squared error" : "error", .is_logarithmic = true};
    set_ranges(drawing, result, k);
    if (const auto found = block.targets.find(norm.name); found != block.targets.end())
        drawing.add_heights(within(found->second, *drawing.y.range), "error to reach");
    return {{name,
             fmt::format("Error against run time: {}; medians of up to {} runs with bars from the "
                         "lower to the upper quartile. Further left and further down is better.{}",
                         norm.words, block.runs,
                         has_zero_time(result) ? " Runs in which the clock shows 0 s are left out."
                                               : ""),
             drawing}};
}

} // namespace

std::vector<Plot> run_time_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    if (const auto* timed = result.get<WorkPrecisionResult>()) {
        const auto& block = *result.scene.get<WorkPrecisionBlock>();
        for (std::size_t k = 0; k < block.norms.size(); ++k)
            for (auto& plot : plot_of(*timed, block, k))
                plots.push_back(std::move(plot));
    }
    return plots;
}

} // namespace tvbeam
