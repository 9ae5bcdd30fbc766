#pragma once

#include "studies/study.hpp"

#include <string>

namespace tvbeam {

/// The result as text for a terminal, 80 columns wide: what was run, a table a study, what the
/// orders show, what was left out.
std::string terminal_report(const StudyResult& result);

} // namespace tvbeam
