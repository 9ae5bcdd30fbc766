#pragma once

#include "reports/plots/free_space.hpp"
#include "reports/plots/plot_style.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// Rows of columns below a heading.
struct DataBlock {
    std::string heading;
    std::string rows;
};

/// What a curve is drawn from: columns of a block, counted from 1; a height, for a line across the
/// figure; or nothing, for what stands in the legend alone.
struct CurveData {
    std::optional<std::size_t> block = {};
    int x = 1;
    int y = 2;
    int third = 0; ///< of a band: its upper edge; of shades: what they show; of bars: the lower end
    int fourth = 0; ///< of bars: the upper end
    std::optional<double> height = {};
};

struct CurveLook {
    enum class Kind {
        lines,
        points,
        lines_and_points,
        bars,   ///< the same, each point with a bar from left to right
        shades, ///< points, in the colour of a number from 0 to 1
        region, ///< what a closed line surrounds
        band    ///< what lies between two lines
    };
    Kind kind = Kind::lines;
    std::string colour = "#000000";
    int point = 0;      ///< gnuplot's number
    double size = 0.9;  ///< of points
    int dash = 1;       ///< gnuplot's number
    double width = 1.6; ///< of lines
};

/// The look of a series: every one its own.
CurveLook look_of(const SeriesStyle& style,
                  CurveLook::Kind kind = CurveLook::Kind::lines_and_points);

struct Curve {
    CurveData data;
    CurveLook look;
    std::optional<std::string> title; ///< its line in the legend
};

struct Axis {
    std::string title = {};
    bool is_logarithmic = false;
    std::optional<std::pair<double, double>> range = {}; ///< absent: that of the data
    double room = 0.0; ///< part of the range of data that stays free on either side
    /// Absent: as the data asks for, on a logarithmic axis at powers of ten.
    std::optional<std::vector<Tick>> ticks = {};
    bool are_minor_ticks_left_out = false;
    double origin = 0.0; ///< taken off the data's numbers where they are drawn
};

/// Text in the middle of a place.
struct PlotLabel {
    std::string text;
    double x = 0.0;
    double y = 0.0;
    int font = 16;            ///< in pixels of a picture 540 wide
    bool is_above = false;    ///< by a line
    bool is_on_white = false; ///< what is behind it does not show
};

/// A figure as it is put together, which gnuplot draws (gnuplot_script) and LaTeX (pgfplots_text):
/// blocks of data, and the curves drawn over them, in order.
class Drawing {
public:
    Axis x = {};
    Axis y = {};
    std::vector<PlotLabel> labels = {};
    bool is_framed = false;    ///< on all sides, without a grid
    std::string backdrop = {}; ///< colour behind everything; empty: white
    std::string scale = {};    ///< what shades show, for the scale beside the axes

    /// Returns what a curve names it by.
    std::size_t add_block(const std::string& heading, const std::string& rows);

    /// Without a line in the legend, or with one. A title is taken as it stands, whatever it holds.
    void add_curve(const CurveData& data, const CurveLook& look,
                   const std::optional<std::string>& title = {});

    /// Lines across the figure, with one line in the legend; of finite heights.
    void add_heights(const std::vector<double>& heights, const std::string& title);

    /// Keeps the axes where they stand, whatever their ticks take: there, in pixels.
    PictureBox fix_axes();

    [[nodiscard]] bool is_empty() const { return curves_.empty(); }
    [[nodiscard]] bool has_fixed_axes() const { return axes_are_fixed_; }
    [[nodiscard]] const std::vector<DataBlock>& blocks() const { return blocks_; }
    [[nodiscard]] const std::vector<Curve>& curves() const { return curves_; }
    [[nodiscard]] std::vector<Curve>& curves() { return curves_; }

    /// In pixels: the width of a picture, the height of it down to the ticks below the axes, and
    /// where the axes stand that are kept.
    static constexpr int plot_width = 540;
    static constexpr int axes_height = 360;
    static constexpr PictureBox frame{116.0, 16.0, 520.0, axes_height};

private:
    std::vector<DataBlock> blocks_;
    std::vector<Curve> curves_;
    bool axes_are_fixed_ = false;
};

} // namespace tvbeam
