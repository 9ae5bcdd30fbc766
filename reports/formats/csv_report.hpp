#pragma once

#include "reports/studies/study_report.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// Every study's table, as csv_report has the first of them.
std::vector<StudyCsv> study_csvs(const StudyResult& result);

/// Whether a file with that name and first line is one of them.
bool is_study_csv(const std::string& name, const std::string& first_line);

/// The ladder as CSV, or the grid of a scene that has no ladder: one row a run, columns elements,
/// h, dt, steps, status, then for each norm its error, and of a ladder also the printed figure
/// (where the scene has them), order and prediction (where there is a model), then seconds and
/// reason. Of a scene that has neither, the rows of [work_precision]: scheme, then the same
/// columns, and in place of seconds their minimum, quartiles and number, and counters; beside a
/// ladder or a grid they stand in the JSON report only.
LongText csv_report(const StudyResult& result);

} // namespace tvbeam
