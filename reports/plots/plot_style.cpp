#include "reports/plots/plot_style.hpp"

#include "reports/document/visible_text.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tvbeam {

namespace {

std::vector<double> sorted(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

} // namespace

SeriesStyle series_style(std::size_t series) {
    static const std::array<SeriesStyle, 7> styles{{{"#0072B2", 7, 1},
                                                    {"#D55E00", 5, 2},
                                                    {"#009E73", 9, 4},
                                                    {"#CC79A7", 11, 5},
                                                    {"#E69F00", 13, 3},
                                                    {"#56B4E9", 15, 1},
                                                    {"#000000", 7, 2}}};
    return styles.at(series % styles.size());
}

std::string gnuplot_text(const std::string& text) {
    std::string quoted = "'";
    for (const char c : visible(text)) {
        // In an SVG, gnuplot puts the text in a section that ends at the first "]]>".
        if (c == '>' && quoted.ends_with("]]"))
            quoted += ' ';
        quoted += c == '\'' ? std::string("''") : std::string(1, c == '\n' || c == '\t' ? ' ' : c);
    }
    return quoted + "'";
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
