#pragma once

#include "reports/document/document.hpp"
#include "studies/stress/stress.hpp"

#include <vector>

namespace tvbeam {

/// The stress study: outcomes by regime, the worst case of each check, the reasons of what was
/// refused or stopped; the contraction map; the round-off table. A section for each that there is.
std::vector<Section> stress_sections(const StressResult& result);

} // namespace tvbeam
