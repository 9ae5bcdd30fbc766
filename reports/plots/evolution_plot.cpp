#include "reports/plots/drawing.hpp"
#include "reports/plots/plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "studies/evolution/evolution.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tvbeam {

namespace {

std::string quantity_words(const NamedProbe& named) {
    switch (named.probe.quantity) {
    case Probe::Quantity::temperature:
        return fmt::format("temperature at x = {}", named.probe.x);
    case Probe::Quantity::deflection:
        return fmt::format("deflection at x = {}", named.probe.x);
    case Probe::Quantity::stress:
        return "contact stress";
    default:
        return "energy";
    }
}

/// What part of the time a figure shows; all of it, or the last two periods.
struct Window {
    std::string name; ///< part of the file's
    std::string words;
    double begin = 0.0;
    double end = 0.0;
    double rounding = 0.0; ///< of times
};

/// Rows of t and value within the window.
std::string rows_of(const EvolutionResult& result, const std::vector<double>& values,
                    const Window& window) {
    std::string rows;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]) && result.t[i] >= window.begin - window.rounding &&
            result.t[i] <= window.end + window.rounding)
            rows += fmt::format("{} {}\n", result.t[i], values[i]);
    return rows;
}

std::vector<Window> windows_of(const EvolutionResult& result, const EvolutionBlock& block) {
    const double rounding = block.rung.dt / 2.0; // of sums of steps, less than this
    std::vector<Window> windows{{"", "", 0.0, block.final_time, rounding}};
    if (!result.periods.empty()) {
        const double period = static_cast<double>(*block.period) * block.rung.dt;
        const double end = result.periods.back().end;
        if (end > 2.0 * period * (1.0 + 1e-9))
            windows.push_back(
                {"_last", ", its last two periods", end - 2.0 * period, end, rounding});
    }
    return windows;
}

Plot plot_of(const EvolutionResult& result, const Scene& scene, std::size_t k,
             const Window& window) {
    const NamedProbe& named = scene.get<EvolutionBlock>()->probes[k];
    const ProbeHistory& probe = result.probes[k];
    Drawing drawing;
    constexpr double width = 1.8;
    drawing.add_curve(
        {.block = drawing.add_block("t, " + probe.name, rows_of(result, probe.values, window))},
        {.colour = series_style(0).colour, .width = width}, "computed");
    if (!probe.exact.empty())
        drawing.add_curve(
            {.block = drawing.add_block("t, exact value", rows_of(result, probe.exact, window))},
            {.colour = series_style(1).colour, .dash = 2, .width = width}, "exact");
    const bool tip = named.probe.quantity == Probe::Quantity::deflection && named.probe.x == 1.0;
    if (tip)
        drawing.add_heights({scene.beam.stops.lower, scene.beam.stops.upper}, "stops");
    const std::string words = quantity_words(named);
    drawing.x = {.title = "time", .range = {{window.begin, window.end}}};
    drawing.y = {.title = words, .room = 0.05};
    return {"evolution_" + named.name + window.name,
            fmt::format("Evolution in time: {}{}.", words, window.words), drawing};
}

} // namespace

std::vector<Plot> evolution_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    const auto* evolution = result.get<EvolutionResult>();
    if (evolution != nullptr && evolution->t.size() > 1)
        for (std::size_t k = 0; k < evolution->probes.size(); ++k)
            for (const auto& window : windows_of(*evolution, *result.scene.get<EvolutionBlock>()))
                plots.push_back(plot_of(*evolution, result.scene, k, window));
    return plots;
}

} // namespace tvbeam
