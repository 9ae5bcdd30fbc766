#pragma once

#include "reports/document/document.hpp"
#include "studies/study.hpp"

namespace tvbeam {

/// What a result has to say: what was run, a section a study, what was left out.
Document result_document(const StudyResult& result);

} // namespace tvbeam
