#pragma once

#include "reports/plots/drawing.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

using Row = std::vector<std::string>;

const std::string& field_of(const Row& row, int column);
double number_of(const Row& row, int column);

/// The rows of a block in which the columns of a curve are finite.
std::vector<Row> rows_of(const Drawing& drawing, const CurveData& data);

/// From the least to the greatest, of an axis: as it is given, or of the data that it can show;
/// turned round where there are none.
using AxisRange = std::pair<double, double>;
AxisRange axis_range(const Drawing& drawing, bool is_x);

/// Evenly apart, and each at the number that it says; none where a range is no wider than rounding.
std::vector<Tick> linear_ticks(const AxisRange& range);

/// At powers of ten, of which there are at most seven.
std::vector<Tick> powers_of_ten(const AxisRange& range);

/// With a range and ticks on each linear axis that has none: what gnuplot and LaTeX would write
/// there is one number, 101325 or 0.0000029, at several. Where numbers differ by less than a
/// thousandth of themselves, a round one is taken off all, as the title says (Axis::origin). And
/// with ticks on each logarithmic one that shows fewer than two powers of ten: at 1, 2 and 5 times
/// those, or evenly apart.
Drawing with_readable_axes(const Drawing& drawing);

} // namespace tvbeam
