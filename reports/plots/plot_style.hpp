#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// How one series of a figure is drawn. Series differ in colour, in point and in line, so that they
/// are distinguishable to those who see no colours, and in grey.
struct SeriesStyle {
    std::string colour; ///< of the palette of Okabe and Ito (2008)
    int point = 0;      ///< gnuplot's number of a filled point
    int dash = 0;       ///< gnuplot's number of a dash pattern
};

/// The style of a series by its number; past the last they begin again.
SeriesStyle series_style(std::size_t series);

/// Text as gnuplot takes it: in single quotes, one line.
std::string gnuplot_text(const std::string& text);

/// The same where gnuplot obeys marks, so that the ∞ of a space L∞ is raised; all else is as it is.
std::string gnuplot_title(const std::string& text);

struct Tick {
    double value = 0.0;
    std::string text;
    std::optional<int> power = {}; ///< of ten, in place of the text
};

/// Of positive ones, in their order, at most `most`, none close to another on a logarithmic axis.
std::vector<Tick> thinned(const std::vector<Tick>& ticks, std::size_t most);

/// Ticks at mesh widths 1/s, as fractions; and at other positive values, as numbers or fractions
/// that are short and, to the digits shown, true. Thinned to at most so many.
std::vector<Tick> width_ticks(std::vector<double> widths, std::size_t most);
std::vector<Tick> value_ticks(std::vector<double> values, std::size_t most);

/// Whether a number can be drawn: next to the greatest double, and on a logarithmic axis to the
/// least, gnuplot has no room for the ends of an axis.
bool is_drawable(double number, bool on_logarithmic_axis = false);

/// All values, and a factor's room on both sides.
std::pair<double, double> range_of(const std::vector<double>& values, double room);

/// Colours of numbers from 0 to 1, evenly apart: from a green that is seen on white to dark.
std::vector<std::string> shades();

} // namespace tvbeam
