/// Of a column of errors: orders with 95 % intervals in each width, and verdicts of its rows.
#pragma once

#include "studies/data/data_analysis.hpp"

#include <vector>

namespace tvbeam {

/// Of a table whose widths are known; `stated`: standard deviations of the errors, one a row; empty
/// where none are, and what rounding leaves open counts. Of up to three widths that are refined by
/// themselves.
ColumnAnalysis analyse_errors(const DataAnalysis& data, const DataColumn& errors,
                              const std::vector<double>& stated);

} // namespace tvbeam
