#pragma once

#include "reports/document/document.hpp"
#include "studies/study.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// What the first line of a result with a [defect] says.
inline constexpr const char* defect_words = "WITH A DELIBERATE DEFECT, not the problem's result";

/// What a result has to say: what was run, a section a study, what was left out.
Document result_document(const StudyResult& result);

/// Where a result of the scene comes from, by the changes (--set) that were asked for.
std::vector<std::pair<std::string, std::string>>
provenance_rows(const Scene& scene, const std::vector<std::string>& overrides);

} // namespace tvbeam
