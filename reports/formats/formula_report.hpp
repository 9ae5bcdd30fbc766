#pragma once

#include "mms/derived_formulas.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What was derived from a solution, as text or as LaTeX (an align* environment), each formula with
/// the times it holds for.
std::string formula_report(const Solution& solution, const std::vector<DerivedFormula>& formulas,
                           bool latex);

} // namespace tvbeam
