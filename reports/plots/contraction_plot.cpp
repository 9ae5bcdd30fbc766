#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/stress/stress.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

namespace {

/// The points of the map whose measured contraction is below 1, or those where it is not.
std::string points_of(const ContractionMap& map, bool contracts) {
    std::string rows;
    for (Eigen::Index i = 0; i < map.measured.rows(); ++i)
        for (Eigen::Index j = 0; j < map.measured.cols(); ++j)
            if (std::isfinite(map.measured(i, j)) && (map.measured(i, j) < 1.0) == contracts)
                rows += fmt::format("{} {} {}\n", map.block.alpha[static_cast<std::size_t>(j)],
                                    map.block.dt[static_cast<std::size_t>(i)], map.measured(i, j));
    return rows;
}

/// The line along which the predicted contraction has one value: it is α² times what depends on Δt
/// alone, hence known for every α from one of them.
std::string level_line(const ContractionMap& map, double level) {
    std::string rows;
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i) {
        const Eigen::Index last = map.predicted.cols() - 1;
        const double alpha = map.block.alpha[static_cast<std::size_t>(last)] *
                             std::sqrt(level / map.predicted(i, last));
        if (std::isfinite(alpha))
            rows +=
                fmt::format("{} {} {}\n", alpha, map.block.dt[static_cast<std::size_t>(i)], level);
    }
    return rows;
}

} // namespace

std::vector<Plot> contraction_plots(const StudyResult& result) {
    const auto* stress = result.get<StressResult>();
    if (stress == nullptr || !stress->contraction)
        return {};
    const ContractionMap& map = *stress->contraction;
    Drawing drawing;
    const auto add = [&](const std::string& rows, const std::string& style,
                         const std::string& title) {
        if (!rows.empty())
            drawing.add_curve(drawing.add_block(title + ": alpha, dt, contraction", rows) +
                                  " using 1:2 " + style,
                              title);
    };
    add(points_of(map, true), "with points pt 6 ps 0.8 lc rgb '#56B4E9' lw 1.4",
        "measured: below 1");
    add(points_of(map, false), "with points pt 2 ps 0.8 lc rgb '#000000' lw 1.4",
        "measured: 1 or more, refused");
    std::size_t line = 0;
    for (const double level : {0.01, 0.1, 1.0})
        add(level_line(map, level),
            fmt::format("with lines lc rgb '#D55E00' dt {} lw 1.6", series_style(line++).dash),
            "predicted: " + shortest(level));
    const std::string settings = fmt::format(
        "set logscale xy\nset format xy '10^{{%L}}'\n{}{}set xlabel 'thermal expansion α'\n"
        "set ylabel 'time step Δt'\n",
        range_text("x", map.block.alpha, 1.3), range_text("y", map.block.dt, 1.3));
    return {drawing.plot(
        "contraction",
        fmt::format("Contraction of the fixed point between temperature and deflection, {}, {} "
                    "mass, zeta = {}: measured at the points; the lines are where it is predicted "
                    "to be 0.01, 0.1 and 1.",
                    map.block.time, name_of(map.block.thermal_mass), shortest(map.block.zeta)),
        settings)};
}

} // namespace tvbeam
