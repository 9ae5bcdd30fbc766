#include "reports/plots/pgfplots_text.hpp"

#include "mms/text/visible_text.hpp"
#include "reports/formats/latex_report.hpp"
#include "reports/plots/readable_axes.hpp"
#include "reports/plots/readable_legend.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tvbeam {

namespace {

/// Of the frame, in widths of the line that the figure stands in.
constexpr double frame_height =
    (Drawing::frame.bottom - Drawing::frame.top) / static_cast<double>(Drawing::plot_width);
constexpr double frame_width =
    (Drawing::frame.right - Drawing::frame.left) / static_cast<double>(Drawing::plot_width);
constexpr double frame_beside_scale = 0.6;

/// gnuplot's width 1 and its point of size 1, in points of TeX.
constexpr double line_unit = 0.55;
constexpr double mark_unit = 2.6;

/// "#D55E00" as the numbers 213, 94, 0.
std::array<int, 3> parts_of(const std::string& colour) {
    const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
    return {part(1), part(3), part(5)};
}

/// As xcolor takes it.
std::string colour_text(const std::string& colour) {
    const auto [red, green, blue] = parts_of(colour);
    return fmt::format("{{rgb,255:red,{};green,{};blue,{}}}", red, green, blue);
}

/// gnuplot's dash patterns 1 to 5.
std::string dash_text(int dash) {
    switch (dash) {
    case 2:
        return "dashed";
    case 3:
        return "dotted";
    case 4:
        return "dashdotted";
    case 5:
        return "dashdotdotted";
    default:
        return "solid";
    }
}

/// A mark by gnuplot's number of the point.
std::string mark_text(int point) {
    switch (point) {
    case 2:
        return "x";
    case 3:
        return "asterisk";
    case 4:
        return "square";
    case 5:
        return "square*";
    case 6:
        return "o";
    case 7:
        return "*";
    case 8:
    case 10:
        return "triangle";
    case 9:
    case 11:
        return "triangle*";
    case 12:
        return "diamond";
    case 13:
        return "diamond*";
    case 14:
        return "pentagon";
    default:
        return "pentagon*";
    }
}

std::string marks_text(const CurveLook& look) {
    const bool is_upside_down = look.point == 10 || look.point == 11;
    return fmt::format("mark={}, mark size={:.2f}pt, mark options={{solid{}}}",
                       mark_text(look.point), mark_unit * look.size,
                       is_upside_down ? ", rotate=180" : "");
}

std::string look_text(const CurveLook& look) {
    using Kind = CurveLook::Kind;
    const std::string colour = colour_text(look.colour);
    const std::string line =
        fmt::format("color={}, line width={:.2f}pt", colour, line_unit * look.width);
    switch (look.kind) {
    case Kind::points:
        return "only marks, " + line + ", " + marks_text(look);
    case Kind::lines_and_points:
    case Kind::bars:
        return line + ", " + dash_text(look.dash) + ", " + marks_text(look);
    case Kind::shades:
        return "scatter, only marks, scatter src=explicit, " + marks_text(look);
    case Kind::region:
    case Kind::band:
        return "draw=none, fill=" + colour + ", area legend";
    default:
        return line + ", " + dash_text(look.dash) + ", mark=none";
    }
}

/// Of a long line the least and the greatest of each stretch: TeX's memory ends at some 20 000
/// points, and a column is no wider than half of these are dots.
std::vector<Row> drawn_rows(std::vector<Row> rows, const Curve& curve) {
    constexpr std::size_t most = 4000;
    if (curve.look.kind != CurveLook::Kind::lines || rows.size() <= most)
        return rows;
    const auto lower = [&curve](const Row& a, const Row& b) {
        return number_of(a, curve.data.y) < number_of(b, curve.data.y);
    };
    std::vector<Row> kept{rows.front()};
    const std::size_t stretch = 2 * rows.size() / most + 1;
    for (std::size_t i = 1; i + 1 < rows.size(); i += stretch) {
        const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end =
            begin + static_cast<std::ptrdiff_t>(std::min(stretch, rows.size() - 1 - i));
        const auto [least, greatest] = std::minmax_element(begin, end, lower);
        kept.push_back(*std::min(least, greatest));
        if (least != greatest)
            kept.push_back(*std::max(least, greatest));
    }
    kept.push_back(rows.back());
    return kept;
}

/// Of a point with a bar: how far it reaches to either side.
std::string bar_text(const Row& row, const CurveData& data) {
    const double x = number_of(row, data.x);
    return fmt::format(" += ({},0) -= ({},0)", number_of(row, data.fourth) - x,
                       x - number_of(row, data.third));
}

/// As it stands in the data, less what is taken off.
std::string coordinate(const Row& row, int column, const Axis& axis) {
    return axis.origin == 0.0 ? field_of(row, column)
                              : fmt::format("{}", number_of(row, column) - axis.origin);
}

std::string coordinates_of(const Drawing& drawing, const Curve& curve) {
    const auto all = rows_of(drawing, curve.data);
    auto rows = drawn_rows(all, curve);
    const auto& [block, x, y, third, fourth, height] = curve.data;
    std::string text;
    if (rows.size() < all.size())
        text += fmt::format("    % of {} points, the least and the greatest of each stretch\n",
                            all.size());
    const auto point = [&drawing](const Row& row, int across, int up) {
        return "    (" + coordinate(row, across, drawing.x) + "," + coordinate(row, up, drawing.y) +
               ")";
    };
    for (const auto& row : rows) {
        text += point(row, x, y);
        if (curve.look.kind == CurveLook::Kind::shades)
            text += " [" + field_of(row, third) + "]";
        if (curve.look.kind == CurveLook::Kind::bars)
            text += bar_text(row, curve.data);
        text += "\n";
    }
    // A band: along the one edge, and back along the other.
    if (curve.look.kind == CurveLook::Kind::band) {
        std::reverse(rows.begin(), rows.end());
        for (const auto& row : rows)
            text += point(row, x, third) + "\n";
    }
    return text;
}

/// What stands in a comment: one line.
std::string comment_text(const std::string& text) {
    std::string line = visible(text);
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

/// Of a number: 10^-3 rather than 1 x 10^-3, which is wider than what gnuplot writes.
std::string latex_label(const std::string& text) {
    const std::string latex = latex_sentence(text);
    const std::string one = "$1\\times";
    return latex.starts_with(one) ? "$" + latex.substr(one.size()) : latex;
}

std::string axis_text(char name, const Axis& axis, const AxisRange& range) {
    std::string text =
        fmt::format("    {}mode={},\n", name, axis.is_logarithmic ? "log" : "normal");
    if (axis.range)
        text += fmt::format("    {0}min={1}, {0}max={2},\n", name, range.first, range.second);
    const auto ticks = axis.ticks            ? *axis.ticks
                       : axis.is_logarithmic ? powers_of_ten(range)
                                             : std::vector<Tick>();
    std::string places;
    std::string labels;
    for (const auto& tick : ticks) {
        places += fmt::format("{}{}", places.empty() ? "" : ",", tick.value);
        labels += fmt::format("{}{{{}}}", labels.empty() ? "" : ",",
                              tick.power ? fmt::format("$10^{{{}}}$", *tick.power)
                                         : latex_label(tick.text));
    }
    if (!ticks.empty())
        text +=
            fmt::format("    {0}tick={{{1}}},\n    {0}ticklabels={{{2}}},\n", name, places, labels);
    if (!axis.title.empty())
        text += fmt::format("    {}label={{{}}},\n", name, latex_text(axis.title));
    return text;
}

std::string curve_text(const Drawing& drawing, const Curve& curve, const AxisRange& across) {
    using Kind = CurveLook::Kind;
    const auto& [block, x, y, third, fourth, height] = curve.data;
    const std::string look = look_text(curve.look);
    const std::string legend =
        curve.title ? "\\addlegendentry{" + latex_text(*curve.title) + "}\n" : "";
    if (!block && !height)
        return "\\addlegendimage{" + look + "}\n" + legend;
    const bool is_closed = curve.look.kind == Kind::region || curve.look.kind == Kind::band;
    const std::string rows = height ? fmt::format("    ({},{})\n    ({},{})\n", across.first,
                                                  *height, across.second, *height)
                                    : coordinates_of(drawing, curve);
    return fmt::format("{}\\addplot[{}{}{}] coordinates {{\n{}}}{};\n{}",
                       block ? "% " + comment_text(drawing.blocks()[*block].heading) + "\n" : "",
                       look, curve.title ? "" : ", forget plot",
                       curve.look.kind == Kind::bars ? ", error bars/.cd, x dir=both, x explicit"
                                                     : "",
                       rows, is_closed ? " -- cycle" : "", legend);
}

std::string node_text(const PlotLabel& label) {
    return fmt::format("\\node[font=\\{}, {}inner sep=1pt] at (axis cs:{},{}) "
                       "{{{}}};\n",
                       label.font > 15 ? "footnotesize" : "scriptsize",
                       label.is_on_white ? "fill=white, "
                       : label.is_above  ? "anchor=south, yshift=2pt, "
                                         : "",
                       label.x, label.y, latex_label(label.text));
}

std::string scale_text(const Drawing& drawing) {
    std::string text = "    colormap={shades}{";
    for (const auto& shade : shades()) {
        const auto [red, green, blue] = parts_of(shade);
        text += fmt::format("rgb255=({},{},{}) ", red, green, blue);
    }
    return text +
           "},\n    point meta min=0, point meta max=1, colorbar,\n    colorbar "
           "style={at={(1.04,1)}, anchor=north west, ylabel={" +
           latex_text(drawing.scale) + "}, width=0.03\\linewidth},\n";
}

std::string options_text(const Drawing& drawing, const AxisRange& across, const AxisRange& along) {
    std::string text = fmt::format(
        "    scale only axis, width={:.3f}\\linewidth, height={:.3f}\\linewidth,\n"
        "    font=\\small, tick align=outside, tick pos=left,\n"
        "    legend cell align=left, xlabel style={{text width=0.75\\linewidth, align=center}},\n"
        "    legend style={{draw=none, fill=none, font=\\footnotesize, at={{(0,0)}}, "
        "anchor=north west, yshift=-3.4em, nodes={{text width=0.68\\linewidth}}}},\n",
        drawing.scale.empty() ? frame_width : frame_beside_scale, frame_height);
    text += drawing.is_framed ? "    axis on top,\n"
                              : "    axis lines*=left, grid=major, grid style={black!13},\n";
    if (!drawing.backdrop.empty())
        text += "    axis background/.style={fill=" + colour_text(drawing.backdrop) + "},\n";
    if (!drawing.scale.empty())
        text += scale_text(drawing);
    return text + axis_text('x', drawing.x, across) + axis_text('y', drawing.y, along);
}

} // namespace

std::string pgfplots_text(const Plot& plot) {
    const Drawing drawing = with_readable_axes(with_readable_legend(plot.drawing));
    const AxisRange across = axis_range(drawing, true);
    std::string text =
        fmt::format("% {0}.tex draws a figure in LaTeX: \\input{{{0}}}, where the preamble has\n"
                    "%     \\usepackage[utf8]{{inputenc}}\n"
                    "%     \\usepackage{{pgfplots}}\n"
                    "%     \\pgfplotsset{{compat=1.18}}\n"
                    "% {1}\n"
                    "\\begin{{tikzpicture}}\n\\begin{{axis}}[\n{2}]\n",
                    plot.name, comment_text(plot.caption),
                    options_text(drawing, across, axis_range(drawing, false)));
    for (const auto& curve : drawing.curves())
        text += curve_text(drawing, curve, across);
    for (const auto& label : drawing.labels)
        text += node_text(label);
    return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

} // namespace tvbeam
