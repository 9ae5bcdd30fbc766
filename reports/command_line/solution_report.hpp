#pragma once

#include "studies/scene/solution_setting.hpp"

#include <string>

namespace tvbeam {

/// What a solution tests and what not: the terms of (1)–(10) that it exercises with their sizes and
/// those that it leaves untested, the residual of the discrete equations under refinement, and the
/// orders to expect with their reasons. Where the solution is not admissible on the beam it says
/// why instead.
std::string solution_report(const SolutionSetting& setting);

} // namespace tvbeam
