#include "reports/plots/gnuplot_script.hpp"

#include "reports/plots/readable_axes.hpp"
#include "reports/plots/readable_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

constexpr double pixels_an_inch = 100.0; ///< of the page of a PDF
constexpr int x_axis = 104;              ///< its ticks and title, below the axes
constexpr double legend_line = 1.725;    ///< of gnuplot's, in heights of its font
constexpr int beside_legend = 90;        ///< its samples and margins

/// In pixels: as large as the longest line of a legend allows; a letter is at most this part of its
/// font as wide, on an average.
int legend_font(std::size_t longest) {
    constexpr double letter = 0.62;
    constexpr int largest = 15;
    constexpr int smallest = 8;
    return std::clamp(
        static_cast<int>((Drawing::plot_width - beside_legend) /
                         (letter * static_cast<double>(std::max<std::size_t>(longest, 1)))),
        smallest, largest);
}

/// Characters of UTF-8.
std::size_t length_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    }));
}

std::string column_text(int column, double origin) {
    return origin == 0.0 ? fmt::format("{}", column) : fmt::format("(${}-({}))", column, origin);
}

std::string source_of(const Drawing& drawing, const Curve& curve) {
    const CurveData& data = curve.data;
    if (data.height)
        return fmt::format("{}", *data.height);
    if (!data.block)
        return "NaN";
    std::string columns =
        column_text(data.x, drawing.x.origin) + ":" + column_text(data.y, drawing.y.origin);
    using Kind = CurveLook::Kind;
    const double origin = curve.look.kind == Kind::band   ? drawing.y.origin
                          : curve.look.kind == Kind::bars ? drawing.x.origin
                                                          : 0.0;
    for (const int more : {data.third, data.fourth})
        if (more > 0)
            columns += ":" + column_text(more, origin);
    return fmt::format("data index {} using {}", *data.block, columns);
}

std::string style_of(const CurveLook& look) {
    const std::string line =
        fmt::format("lc rgb '{}' dt {} lw {}", look.colour, look.dash, look.width);
    const std::string point = fmt::format("pt {} ps {}", look.point, look.size);
    const std::string fill = "fillstyle solid noborder fillcolor rgb '" + look.colour + "'";
    switch (look.kind) {
    case CurveLook::Kind::points:
        return fmt::format("points {} lc rgb '{}' lw {}", point, look.colour, look.width);
    case CurveLook::Kind::lines_and_points:
        return "linespoints " + line + " " + point;
    case CurveLook::Kind::bars:
        return "xerrorlines " + line + " " + point;
    case CurveLook::Kind::shades:
        return "points " + point + " lc palette";
    case CurveLook::Kind::region:
        return "filledcurves closed " + fill;
    case CurveLook::Kind::band:
        return "filledcurves " + fill;
    default:
        return "lines " + line;
    }
}

std::string curves_text(const Drawing& drawing) {
    std::string text;
    for (const auto& curve : drawing.curves())
        text += fmt::format("{}{} with {} {}", text.empty() ? "" : ", \\\n     ",
                            source_of(drawing, curve), style_of(curve.look),
                            curve.title ? "title " + gnuplot_title(*curve.title) : "notitle");
    return text;
}

std::string ticks_text(const std::vector<Tick>& ticks) {
    std::string text;
    for (const auto& tick : ticks)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                            tick.power ? fmt::format("'10^{{{}}}'", *tick.power)
                                       : gnuplot_text(tick.text),
                            tick.value);
    return "(" + text + ")";
}

std::string axis_text(char name, const Axis& axis, bool is_fixed) {
    std::string text;
    if (axis.is_logarithmic)
        text += fmt::format("set logscale {}\n", name);
    if (axis.range)
        text += fmt::format("set {}range [{}:{}]\n", name, axis.range->first, axis.range->second);
    if (axis.ticks)
        text += fmt::format("set {}tics {}\n", name, ticks_text(*axis.ticks));
    else if (axis.is_logarithmic)
        text += fmt::format("set format {} '10^{{%L}}'\n", name);
    if (axis.are_minor_ticks_left_out)
        text += fmt::format("unset m{}tics\n", name);
    if (!axis.title.empty())
        text += fmt::format("set {}label {} noenhanced{}\n", name, gnuplot_text(axis.title),
                            name == 'y' && is_fixed ? " offset 1.5,0" : "");
    return text;
}

std::string label_text(const PlotLabel& label) {
    return fmt::format("set label {} at {},{} center {}{}front font ',{}' noenhanced\n",
                       gnuplot_text(label.text), label.x, label.y,
                       label.is_above ? "offset 0,0.8 " : "", label.is_on_white ? "boxed " : "",
                       label.font);
}

std::string settings_text(const Drawing& drawing) {
    std::string text = axis_text('x', drawing.x, drawing.has_fixed_axes()) +
                       axis_text('y', drawing.y, drawing.has_fixed_axes());
    if (drawing.is_framed)
        text += "set clip two\nset border 15\nunset grid\n";
    if (!drawing.backdrop.empty())
        text += fmt::format("set object rectangle from graph 0,0 to graph 1,1 behind fillstyle "
                            "solid noborder fillcolor rgb '{}'\n",
                            drawing.backdrop);
    if (!drawing.scale.empty()) {
        text += "set palette defined (";
        const auto colours = shades();
        for (std::size_t i = 0; i < colours.size(); ++i)
            text += fmt::format("{}{} '{}'", i == 0 ? "" : ", ",
                                static_cast<double>(i) / static_cast<double>(colours.size() - 1),
                                colours[i]);
        text += fmt::format(")\nset cbrange [0:1]\nset cblabel {} noenhanced\n",
                            gnuplot_text(drawing.scale));
    }
    if (std::any_of(drawing.labels.begin(), drawing.labels.end(),
                    [](const PlotLabel& label) { return label.is_on_white; }))
        text += "set style textbox opaque noborder fillcolor 'white' margins 0.6,0.6\n";
    for (const auto& label : drawing.labels)
        text += label_text(label);
    return text;
}

} // namespace

std::string gnuplot_script(const Drawing& given, const std::string& name) {
    const Drawing drawing = with_readable_axes(with_readable_legend(given));
    std::size_t legend = 0;
    std::size_t longest = 0;
    for (const auto& curve : drawing.curves())
        if (curve.title) {
            ++legend;
            longest = std::max(longest, length_of(*curve.title));
        }
    const int font = legend_font(longest);
    const int below =
        static_cast<int>(std::ceil(legend_line * font * static_cast<double>(legend))) + x_axis;
    const int height = Drawing::axes_height + below;
    const std::string margins = fmt::format(
        "set tmargin at screen {:.4f}\nset lmargin at screen {:.4f}\nset rmargin at screen "
        "{:.4f}\n",
        1.0 - Drawing::frame.top / height, Drawing::frame.left / Drawing::plot_width,
        Drawing::frame.right / Drawing::plot_width);
    // Drawn once for each kind of file.
    return fmt::format(
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
        name, Drawing::plot_width, height, static_cast<double>(below) / height,
        std::max<std::size_t>(legend, 1), settings_text(drawing), curves_text(drawing),
        2 * Drawing::plot_width, 2 * height, drawing.has_fixed_axes() ? margins : "", font,
        Drawing::plot_width / pixels_an_inch, height / pixels_an_inch);
}

std::string gnuplot_data(const Drawing& drawing) {
    std::string text;
    for (const auto& block : drawing.blocks())
        text += (text.empty() ? "# " : "\n\n# ") + block.heading + "\n" + block.rows;
    return text;
}

} // namespace tvbeam
