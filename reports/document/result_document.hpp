#pragma once

#include "reports/document/document.hpp"
#include "studies/study.hpp"

namespace tvbeam {

/// What a result has to say: what was run, a section a study, what was left out.
/// What the first line of a result with a [defect] says.
inline constexpr const char* defect_words = "WITH A DELIBERATE DEFECT, not the problem's result";

Document result_document(const StudyResult& result);

} // namespace tvbeam
