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
        const std::size_t data = drawing.add_block(
            block.schemes[j].name +
                ": median of the seconds, error, lower quartile, upper quartile, elements, dt",
            rows);
        drawing.add_curve({.block = data, .third = 3, .fourth = 4},
                          look_of(series_style(j), CurveLook::Kind::bars), block.schemes[j].name);
    }
    if (drawing.is_empty())
        return {};
    if (const auto found = block.targets.find(norm.name); found != block.targets.end())
        drawing.add_heights(found->second, "error to reach");
    const std::string name = "run_time_" + norm.name;
    drawing.x = {.title = "run time in seconds, median and quartiles", .is_logarithmic = true};
    drawing.y = {.title = norm.squared ? "squared error" : "error", .is_logarithmic = true};
    return {{name,
             fmt::format("Error against run time: {}; medians of up to {} runs with bars from the "
                         "lower to the upper quartile. Further left and further down is better.",
                         norm.words, block.runs),
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
