#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/stress/stress.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

namespace {

/// The points of the map where runs are taken, or those where they are refused.
std::string points_of(const ContractionMap& map, bool contracts) {
    std::string rows;
    for (Eigen::Index i = 0; i < map.measured.rows(); ++i)
        for (Eigen::Index j = 0; j < map.measured.cols(); ++j)
            if (std::isfinite(map.measured(i, j)) && (map.greatest(i, j) < 1.0) == contracts)
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
    const auto add = [&](const std::string& rows, const CurveLook& look, const std::string& title) {
        if (!rows.empty())
            drawing.add_curve(
                {.block = drawing.add_block(title + ": alpha, dt, contraction", rows)}, look,
                title);
    };
    const auto points = [](const char* colour, int point) {
        return CurveLook{.kind = CurveLook::Kind::points,
                         .colour = colour,
                         .point = point,
                         .size = 0.8,
                         .width = 1.4};
    };
    add(points_of(map, true), points("#56B4E9", 6), "measured, run taken");
    add(points_of(map, false), points("#000000", 2), "measured, refused");
    std::size_t line = 0;
    for (const double level : {0.01, 0.1, 1.0})
        add(level_line(map, level), {.colour = "#D55E00", .dash = series_style(line++).dash},
            "predicted: " + shortest(level));
    if (drawing.is_empty())
        return {};
    constexpr double room = 1.3;
    drawing.x = {.title = "thermal expansion α",
                 .is_logarithmic = true,
                 .range = range_of(map.block.alpha, room)};
    drawing.y = {
        .title = "time step Δt", .is_logarithmic = true, .range = range_of(map.block.dt, room)};
    return {
        {"contraction",
         fmt::format("Contraction of the fixed point between temperature and deflection, {}, {} "
                     "mass, zeta = {}: measured at the points; the lines are where it is predicted "
                     "to be 0.01, 0.1 and 1{}.",
                     map.block.time, name_of(map.block.thermal_mass), shortest(map.block.zeta),
                     (map.greatest > map.predicted).any()
                         ? "; runs are refused by the first step, too, whose is larger"
                         : ""),
         drawing}};
}

} // namespace tvbeam
