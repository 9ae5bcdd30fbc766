#pragma once

#include "reports/document/document.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/scene/scene.hpp"

namespace tvbeam {

/// What each probe ranged over, the contact events, and what changed from period to period.
Section evolution_section(const EvolutionResult& result, const Scene& scene);

} // namespace tvbeam
