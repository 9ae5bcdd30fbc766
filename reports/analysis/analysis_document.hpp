#pragma once

#include "reports/document/document.hpp"
#include "studies/data/data_analysis.hpp"

namespace tvbeam {

/// The analysis of a table in words and tables: a section a column. Of very many rows the first and
/// the last stand in it.
Document analysis_document(const DataAnalysis& analysis);

} // namespace tvbeam
