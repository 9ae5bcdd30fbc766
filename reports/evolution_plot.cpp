#include "reports/plot.hpp"
#include "reports/plot_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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

/// The name of a probe in letters, digits and _, which gnuplot takes in names.
std::string file_part(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

/// What part of the time a figure shows; all of it, or the last two periods.
struct Window {
    std::string name; ///< part of the file's
    std::string words;
    double begin = 0.0;
    double end = 0.0;
};

/// Blocks of columns: t, value; then t, exact value.
std::string data_of(const EvolutionResult& result, const ProbeHistory& probe,
                    const Window& window) {
    std::string data = "# t, " + probe.name + "\n";
    const auto add = [&](const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            if (std::isfinite(values[i]) && result.t[i] >= window.begin &&
                result.t[i] <= window.end)
                data += fmt::format("{} {}\n", result.t[i], values[i]);
    };
    add(probe.values);
    if (!probe.exact.empty()) {
        data += "\n\n# t, exact value\n";
        add(probe.exact);
    }
    return data;
}

/// Lines at the stops that the tip can meet.
std::string stop_lines(const Stops& stops) {
    std::string curves;
    for (const double stop : {stops.lower, stops.upper})
        if (std::isfinite(stop))
            curves += fmt::format(", \\\n     {} with lines lc rgb '#555555' dt 3 lw 1.2 {}", stop,
                                  curves.empty() ? "title 'stops'" : "notitle");
    return curves;
}

std::vector<Window> windows_of(const EvolutionResult& result, const EvolutionBlock& block) {
    std::vector<Window> windows{{"", "", 0.0, block.final_time}};
    if (!result.periods.empty()) {
        const double period = static_cast<double>(*block.period) * block.rung.dt;
        const double end = result.periods.back().end;
        if (end > 2.0 * period * (1.0 + 1e-9))
            windows.push_back({"_last", ", its last two periods", end - 2.0 * period, end});
    }
    return windows;
}

Plot plot_of(const EvolutionResult& result, const Scene& scene, std::size_t k,
             const Window& window) {
    const NamedProbe& named = scene.evolution->probes[k];
    const ProbeHistory& probe = result.probes[k];
    const SeriesStyle style = series_style(0);
    std::string curves =
        fmt::format("data index 0 using 1:2 with lines lc rgb '{}' lw 1.8 title {}", style.colour,
                    gnuplot_text("computed"));
    std::size_t legend = 1;
    if (!probe.exact.empty()) {
        const SeriesStyle exact = series_style(1);
        curves += fmt::format(", \\\n     data index 1 using 1:2 with lines lc rgb '{}' dt {} lw "
                              "1.8 title 'exact'",
                              exact.colour, 2);
        ++legend;
    }
    const bool tip = named.probe.quantity == Probe::Quantity::deflection && named.probe.x == 1.0;
    if (tip && scene.beam.stops.exist()) {
        curves += stop_lines(scene.beam.stops);
        ++legend;
    }
    const std::string words = quantity_words(named);
    const std::string name = "evolution_" + file_part(named.name) + window.name;
    const std::string body =
        fmt::format("set xlabel 'time'\nset ylabel {}\nset xrange [{}:{}]\nset offsets 0, 0, graph "
                    "0.05, graph 0.05\nplot {}\n",
                    gnuplot_text(words), window.begin, window.end, curves);
    return {name, fmt::format("Evolution in time: {}{}.", words, window.words),
            plot_script(name, legend, body), data_of(result, probe, window)};
}

} // namespace

std::vector<Plot> evolution_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    if (result.evolution && result.evolution->t.size() > 1)
        for (std::size_t k = 0; k < result.evolution->probes.size(); ++k)
            for (const auto& window : windows_of(*result.evolution, *result.scene.evolution))
                plots.push_back(plot_of(*result.evolution, result.scene, k, window));
    return plots;
}

} // namespace tvbeam
