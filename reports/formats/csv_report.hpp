#pragma once

#include "studies/study.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// The table of one study as CSV.
struct StudyCsv {
    std::string study; ///< the name of its block: "ladder", "orders", "work_precision", "stress";
                       ///< "contraction" and "roundoff" of [stress]
    std::string text;
};

/// Every study's table, as csv_report has the first of them.
std::vector<StudyCsv> study_csvs(const StudyResult& result);

/// Whether a file with that name and first line is one of them.
bool is_study_csv(const std::string& name, const std::string& first_line);

/// The ladder as CSV (RFC 4180, but with \n), or the grid of a scene that has no ladder: one row a
/// run, columns elements, h, dt, steps, status, then for each norm its error, and of a ladder also
/// the printed figure (where the scene has them), order and prediction (where there is a model),
/// then seconds and reason. Of a scene that has neither, the rows of [work_precision]: scheme, then
/// the same columns, and in place of seconds their minimum, quartiles and number, and counters;
/// beside a ladder or a grid they stand in the JSON report only. Numbers read back to the same
/// doubles; an undefined number is an empty field.
std::string csv_report(const StudyResult& result);

} // namespace tvbeam
