#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/text/number_text.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

/// The rows of a scheme that were timed and have an error > 0.
std::string rows_of(const SchemeRuns& scheme, std::size_t k) {
    std::string rows;
    for (std::size_t i = 0; i < scheme.runs.size(); ++i) {
        const RungResult& run = scheme.runs[i];
        const auto& timing = scheme.timings[i];
        if (timing && !run.errors.empty() && run.errors[k] > 0.0)
            rows += fmt::format("{} {} {} {} {} {}\n", timing->median, run.errors[k], timing->q1,
                                timing->q3, run.rung.elements, run.rung.dt);
    }
    return rows;
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
        const SeriesStyle style = series_style(j);
        const std::string data = drawing.add_block(
            block.schemes[j].name +
                ": median of the seconds, error, lower quartile, upper quartile, elements, dt",
            rows);
        drawing.add_curve(
            fmt::format("{} using 1:2:3:4 with xerrorlines lc rgb '{}' pt {} ps 0.9 dt {} lw 1.6",
                        data, style.colour, style.point, style.dash),
            block.schemes[j].name);
    }
    if (drawing.is_empty())
        return {};
    std::string targets;
    if (const auto found = block.targets.find(norm.name); found != block.targets.end()) {
        for (const double target : found->second)
            targets += fmt::format("set arrow from graph 0,first {0} to graph 1,first {0} nohead "
                                   "lc rgb '#555555' dt 3 lw 1.2\n",
                                   target);
        drawing.add_curve("NaN with lines lc rgb '#555555' dt 3 lw 1.2", "error to reach");
    }
    const std::string name = "run_time_" + norm.name;
    const std::string settings = fmt::format(
        "set logscale xy\nset format xy '10^{{%L}}'\nset xlabel 'run time in seconds, median and "
        "quartiles'\nset ylabel {}\n{}",
        norm.squared ? "'squared error'" : "'error'", targets);
    return {drawing.plot(
        name,
        fmt::format("Error against run time: {}; medians of up to {} runs with bars from the "
                    "lower to the upper quartile. Further left and further down is better.",
                    norm.words, block.runs),
        settings)};
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
