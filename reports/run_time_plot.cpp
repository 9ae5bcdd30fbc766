#include "reports/norm_words.hpp"
#include "reports/number_text.hpp"
#include "reports/plot.hpp"
#include "reports/plot_style.hpp"

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
    const Norm& norm = block.norms[k];
    std::string data;
    std::string curves;
    std::size_t drawn = 0;
    for (std::size_t j = 0; j < block.schemes.size(); ++j) {
        const std::string rows = rows_of(result.schemes[j], k);
        if (rows.empty())
            continue;
        const SeriesStyle style = series_style(j);
        curves += fmt::format(
            "{}data index {} using 1:2:3:4 with xerrorlines lc rgb '{}' pt {} ps 0.9 dt {} lw 1.6 "
            "title {}",
            drawn == 0 ? "" : ", \\\n     ", drawn, style.colour, style.point, style.dash,
            gnuplot_text(block.schemes[j].name));
        data += fmt::format("{}# {}: median of the seconds, error, lower quartile, upper quartile, "
                            "elements, dt\n{}",
                            drawn == 0 ? "" : "\n\n", block.schemes[j].name, rows);
        ++drawn;
    }
    if (drawn == 0)
        return {};
    std::string targets;
    std::size_t legend = drawn;
    if (const auto found = block.targets.find(norm.name); found != block.targets.end()) {
        for (const double target : found->second)
            targets += fmt::format("set arrow from graph 0,first {0} to graph 1,first {0} nohead "
                                   "lc rgb '#555555' dt 3 lw 1.2\n",
                                   target);
        curves += ", \\\n     NaN with lines lc rgb '#555555' dt 3 lw 1.2 title 'error to "
                  "reach'";
        ++legend;
    }
    const std::string name = "run_time_" + norm.name;
    const std::string body = fmt::format(
        "set logscale xy\nset format xy '10^{{%L}}'\nset xlabel 'run time in seconds, median and "
        "quartiles'\nset ylabel {}\n{}plot {}\n",
        norm.squared ? "'squared error'" : "'error'", targets, curves);
    return {{name,
             fmt::format("Error against run time: {}; medians of up to {} runs with bars from the "
                         "lower to the upper quartile. Further left and further down is better.",
                         norm_words(norm.name), block.runs),
             plot_script(name, legend, body), data}};
}

} // namespace

std::vector<Plot> run_time_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    if (result.work_precision)
        for (std::size_t k = 0; k < result.scene.work_precision->norms.size(); ++k)
            for (auto& plot : plot_of(*result.work_precision, *result.scene.work_precision, k))
                plots.push_back(std::move(plot));
    return plots;
}

} // namespace tvbeam
