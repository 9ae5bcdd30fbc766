#pragma once

#include "studies/data/record_analysis.hpp"

#include <string>

namespace tvbeam {

/// The analysis as text for a terminal.
std::string analysis_report(const RecordAnalysis& analysis);

} // namespace tvbeam
