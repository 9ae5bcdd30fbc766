#include "reports/plot_style.hpp"

#include "reports/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tvbeam {

namespace {

constexpr int plot_width = 540;
constexpr int axes_height = 360;
constexpr int x_axis = 104; ///< its ticks and title, below the axes
constexpr int legend_line = 23;

std::vector<double> sorted(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

} // namespace

SeriesStyle series_style(std::size_t series) {
    static const std::array<SeriesStyle, 7> styles{{{"#0072B2", 7, 6, 1},
                                                    {"#D55E00", 5, 4, 2},
                                                    {"#009E73", 9, 8, 4},
                                                    {"#CC79A7", 11, 10, 5},
                                                    {"#E69F00", 13, 12, 3},
                                                    {"#56B4E9", 15, 14, 1},
                                                    {"#000000", 7, 6, 2}}};
    return styles.at(series % styles.size());
}

std::string gnuplot_text(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text)
        quoted += c == '\'' ? std::string("''")
                            : std::string(1, static_cast<unsigned char>(c) < ' ' ? ' ' : c);
    return quoted + "'";
}

std::string plot_script(const std::string& name, std::size_t legend, const std::string& body) {
    const int below = legend_line * static_cast<int>(legend) + x_axis;
    const int height = axes_height + below;
    const std::string head = fmt::format(
        "# Draws {0}.svg and {0}.png from {0}.dat:\n"
        "#     gnuplot {0}.gp\n"
        "set encoding utf8\n"
        "set terminal svg size {1},{2} font 'sans-serif,18' background 'white' name '{0}'\n"
        "set output '{0}.svg'\n"
        "data = '{0}.dat'\n"
        "set datafile missing 'NaN'\n"
        "set border 3 lw 1.2\n"
        "set tics nomirror out\n"
        "set grid lc rgb '#dddddd' lt 1 lw 0.7\n"
        "set bmargin at screen {3:.4f}\n"
        "set key at screen 0.04,screen 0.01 left bottom vertical maxrows {4}\n"
        "set key reverse Left noenhanced samplen 3 font ',16'\n",
        name, plot_width, height, static_cast<double>(below) / height,
        std::max<std::size_t>(legend, 1));
    const std::string again = fmt::format(
        "set terminal pngcairo size {},{} font 'sans,18' fontscale 1.55 linewidth 2 pointscale 2\n"
        "set output '{}.png'\n"
        "replot\n"
        "set output\n",
        2 * plot_width, 2 * height, name);
    return head + body + again;
}

std::string ticks_text(const std::vector<Tick>& ticks, std::size_t most) {
    const std::size_t step = (ticks.size() + most - 1) / std::max<std::size_t>(most, 1);
    std::string text;
    for (std::size_t i = 0; i < ticks.size(); i += std::max<std::size_t>(step, 1))
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", gnuplot_text(ticks[i].text),
                            ticks[i].value);
    return "(" + text + ")";
}

std::vector<Tick> width_ticks(std::vector<double> widths) {
    std::vector<Tick> ticks;
    for (const double h : sorted(std::move(widths)))
        ticks.push_back({h, fmt::format("1/{}", std::llround(1.0 / h))});
    return ticks;
}

std::vector<Tick> value_ticks(std::vector<double> values) {
    std::vector<Tick> ticks;
    for (const double value : sorted(std::move(values)))
        ticks.push_back({value, shortest(value)});
    return ticks;
}

std::string range_text(const char* axis, const std::vector<double>& values, double room) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    return fmt::format("set {}range [{}:{}]\n", axis, *least / room, *greatest * room);
}

} // namespace tvbeam
