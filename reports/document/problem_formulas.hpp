#pragma once

#include "reports/formats/html_report.hpp"
#include "studies/scene/scene.hpp"

#include <vector>

namespace tvbeam {

/// The formulas of a scene's problem: of an exact solution its θ, u and σ and what was derived from
/// them, else the data that the scene gives. Empty where it has neither, as a stress study.
std::vector<Formula> problem_formulas(const Scene& scene);

} // namespace tvbeam
