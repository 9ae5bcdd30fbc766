#include "reports/plots/drawing.hpp"

#include "reports/plots/plot_style.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tvbeam {

namespace {

constexpr double pixels_an_inch = 100.0; ///< of the page of a PDF
constexpr int plot_width = 540;
constexpr int axes_height = 360;
constexpr int x_axis = 114; ///< its ticks and title, below the axes
constexpr int legend_line = 21;
constexpr PictureBox frame{116.0, 16.0, 520.0, axes_height};
constexpr int beside_legend = 90; ///< its samples and margins

/// In pixels: as large as the longest line of a legend allows; a letter is at most this part of its
/// font as wide, on an average.
int legend_font(std::size_t longest) {
    constexpr double letter = 0.62;
    constexpr int largest = 15;
    constexpr int smallest = 8;
    return std::clamp(
        static_cast<int>((plot_width - beside_legend) /
                         (letter * static_cast<double>(std::max<std::size_t>(longest, 1)))),
        smallest, largest);
}

/// Characters of UTF-8.
std::size_t length_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

} // namespace

std::string Drawing::add_block(const std::string& heading, const std::string& rows) {
    data_ += (blocks_ == 0 ? "# " : "\n\n# ") + heading + "\n" + rows;
    return "data index " + std::to_string(blocks_++);
}

void Drawing::add_curve(const std::string& curve) {
    curves_ += (curves_.empty() ? "" : ", \\\n     ") + curve + " notitle";
}

void Drawing::add_curve(const std::string& curve, const std::string& title) {
    curves_ += (curves_.empty() ? "" : ", \\\n     ") + curve + " title " + gnuplot_title(title);
    ++legend_;
    longest_title_ = std::max(longest_title_, length_of(title));
}

PictureBox Drawing::fix_axes() {
    axes_are_fixed_ = true;
    return frame;
}

Plot Drawing::plot(const std::string& name, const std::string& caption,
                   const std::string& settings) const {
    const int below = legend_line * static_cast<int>(legend_) + x_axis;
    const int height = axes_height + below;
    const std::string margins =
        fmt::format("set tmargin at screen {:.4f}\nset lmargin at screen {:.4f}\nset rmargin at "
                    "screen {:.4f}\n",
                    1.0 - frame.top / height, frame.left / plot_width, frame.right / plot_width);
    // Drawn once for each kind of file.
    const std::string script = fmt::format(
        "# Draws {0}.svg, {0}.png and {0}.pdf from {0}.dat:\n"
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
        "{9}"
        "set key at screen 0.04,screen 0.01 left bottom vertical maxrows {4}\n"
        "set key reverse Left enhanced samplen 3 spacing 1.15 font ',{10}'\n"
        "{5}plot {6}\n"
        "set terminal pngcairo size {7},{8} font 'sans,18' fontscale 1.5 linewidth 2 pointscale 2\n"
        "set output '{0}.png'\n"
        "replot\n"
        "set terminal pdfcairo size {11:.2f},{12:.2f} font 'sans,13' linewidth 1.2 pointscale 0.7\n"
        "set output '{0}.pdf'\n"
        "replot\n"
        "set output\n",
        name, plot_width, height, static_cast<double>(below) / height,
        std::max<std::size_t>(legend_, 1), settings, curves_, 2 * plot_width, 2 * height,
        axes_are_fixed_ ? margins : "", legend_font(longest_title_), plot_width / pixels_an_inch,
        height / pixels_an_inch);
    return {name, caption, script, data_};
}

} // namespace tvbeam
