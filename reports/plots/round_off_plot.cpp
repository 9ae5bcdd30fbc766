#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/stress/stress.hpp"

#include <fmt/format.h>

#include <functional>
#include <optional>

namespace tvbeam {

namespace {

/// One of the figures of a row, against the number of elements.
struct Curve {
    std::string name;
    std::function<std::optional<double>(const RoundOffRow&)> value;
};

const std::vector<Curve>& curves() {
    static const std::vector<Curve> all{
        {"moment form, nodal values", [](const auto& row) { return row.moment.value; }},
        {"moment form, sine basis", [](const auto& row) { return row.sine; }},
        {"Hermite form", [](const auto& row) { return row.hermite.value; }},
        {"Hermite form, predicted",
         [](const auto& row) { return std::optional(row.hermite_predicted); }},
        {"discretisation error",
         [](const auto& row) { return std::optional(row.discretisation_error); }}};
    return all;
}

} // namespace

std::vector<Plot> round_off_plots(const StudyResult& result) {
    const auto* stress = result.get<StressResult>();
    if (stress == nullptr || !stress->roundoff)
        return {};
    Drawing drawing;
    std::vector<double> elements;
    for (const auto& row : stress->roundoff->rows)
        elements.push_back(static_cast<double>(row.elements));
    std::size_t series = 0;
    for (const auto& curve : curves()) {
        std::string rows;
        for (const auto& row : stress->roundoff->rows)
            if (const auto value = curve.value(row); value && *value > 0.0)
                rows += fmt::format("{} {}\n", row.elements, *value);
        const SeriesStyle style = series_style(series++);
        if (rows.empty())
            continue;
        drawing.add_curve(
            {.block = drawing.add_block(curve.name + ": elements, relative error", rows)},
            look_of(style), curve.name);
    }
    if (drawing.is_empty())
        return {};
    drawing.x = {.title = "elements s", .is_logarithmic = true, .range = range_of(elements, 1.5)};
    drawing.y = {.title = "relative error", .is_logarithmic = true};
    return {
        {"round_off",
         "Floor of round-off under the errors, against the number of elements: measured on the "
         "coupled mode sin(pi x), and as the h^-4 law of the Hermite basis predicts it. Where a "
         "floor lies above the discretisation error, a finer mesh gains nothing.",
         drawing}};
}

} // namespace tvbeam
