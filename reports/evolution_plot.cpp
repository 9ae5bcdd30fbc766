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

/// Blocks of columns: t, value; then t, exact value.
std::string data_of(const EvolutionResult& result, const ProbeHistory& probe) {
    std::string data = "# t, " + probe.name + "\n";
    const auto add = [&](const std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            if (std::isfinite(values[i]))
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

Plot plot_of(const EvolutionResult& result, const Scene& scene, std::size_t k) {
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
    const std::string name = "evolution_" + file_part(named.name);
    const std::string body =
        fmt::format("set xlabel 'time'\nset ylabel {}\nset xrange [0:{}]\nset offsets 0, 0, graph "
                    "0.05, graph 0.05\nplot {}\n",
                    gnuplot_text(words), scene.evolution->final_time, curves);
    return {name, fmt::format("Evolution in time: {}.", words), plot_script(name, legend, body),
            data_of(result, probe)};
}

} // namespace

std::vector<Plot> evolution_plots(const StudyResult& result) {
    std::vector<Plot> plots;
    if (result.evolution && result.evolution->t.size() > 1)
        for (std::size_t k = 0; k < result.evolution->probes.size(); ++k)
            plots.push_back(plot_of(*result.evolution, result.scene, k));
    return plots;
}

} // namespace tvbeam
