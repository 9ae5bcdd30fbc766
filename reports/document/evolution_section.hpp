#pragma once

#include "reports/document/document.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/scene/scene.hpp"

#include <string>

namespace tvbeam {

/// What each probe ranged over, the contact events, and what changed from period to period.
Section evolution_section(const EvolutionResult& result, const Scene& scene);

/// "onset", "release"
std::string name_of(ContactEvent::Kind kind);

/// "g1", "g2"
std::string name_of(ContactEvent::Stop stop);

} // namespace tvbeam
