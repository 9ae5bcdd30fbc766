#include "reports/plots/drawing.hpp"

#include "reports/plots/plot_style.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tvbeam {

namespace {

constexpr int plot_width = 540;
constexpr int axes_height = 360;
constexpr int x_axis = 104; ///< its ticks and title, below the axes
constexpr int legend_line = 23;

} // namespace

std::string Drawing::add_block(const std::string& heading, const std::string& rows) {
    data_ += (blocks_ == 0 ? "# " : "\n\n# ") + heading + "\n" + rows;
    return "data index " + std::to_string(blocks_++);
}

void Drawing::add_curve(const std::string& curve) {
    curves_ += (curves_.empty() ? "" : ", \\\n     ") + curve + " notitle";
}

void Drawing::add_curve(const std::string& curve, const std::string& title) {
    curves_ += (curves_.empty() ? "" : ", \\\n     ") + curve + " title " + gnuplot_text(title);
    ++legend_;
}

Plot Drawing::plot(const std::string& name, const std::string& caption,
                   const std::string& settings) const {
    const int below = legend_line * static_cast<int>(legend_) + x_axis;
    const int height = axes_height + below;
    // Drawn once for NAME.svg, and once for NAME.png.
    const std::string script = fmt::format(
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
        "set key reverse Left noenhanced samplen 3 font ',16'\n"
        "{5}plot {6}\n"
        "set terminal pngcairo size {7},{8} font 'sans,18' fontscale 1.55 linewidth 2 pointscale "
        "2\n"
        "set output '{0}.png'\n"
        "replot\n"
        "set output\n",
        name, plot_width, height, static_cast<double>(below) / height,
        std::max<std::size_t>(legend_, 1), settings, curves_, 2 * plot_width, 2 * height);
    return {name, caption, script, data_};
}

} // namespace tvbeam
