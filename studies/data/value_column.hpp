/// Of a column of values whose limit nobody knows: the limit and the order, with 95 % intervals.
#pragma once

#include "studies/data/data_analysis.hpp"

#include <vector>

namespace tvbeam {

/// Of a table whose widths are known, where its rows are refined along one path; `sigma`: standard
/// deviations of the values, one a row; empty where none are stated, and the digits printed count.
ColumnAnalysis analyse_values(const DataAnalysis& data, const DataColumn& values,
                              const std::vector<double>& sigma);

} // namespace tvbeam
