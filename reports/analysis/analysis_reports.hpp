#pragma once

#include "reports/formats/report_format.hpp"
#include "studies/data/data_analysis.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace tvbeam {

/// The analysis of a table as JSON, schema tvbeam-analysis/1: what cannot be said is null, with a
/// status in words beside it.
std::string analysis_json(const DataAnalysis& analysis);

/// What a column shows, as more keys of an object: orders, findings; of values limit, uncertainty
/// and methods.
void add_analysis(nlohmann::ordered_json& json, const DataAnalysis& analysis,
                  const ColumnAnalysis& column);

/// Each value against the first width that is refined, with its limit.
std::vector<Plot> value_plots(const DataAnalysis& analysis);

/// Its rows as CSV: the widths, then of each column its numbers, orders and verdicts.
std::string analysis_csv(const DataAnalysis& analysis);

/// The errors against the first width that is refined, and what is determined of their orders; each
/// value against it, with its limit.
std::vector<Plot> analysis_plots(const DataAnalysis& analysis);

/// For the directory of --out.
Reported reported(const DataAnalysis& analysis);

} // namespace tvbeam
