#pragma once

#include "studies/evolution/evolution.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tvbeam {

/// The block "evolution" of a result, without what every run says of itself.
nlohmann::ordered_json evolution_json(const EvolutionResult& result);

} // namespace tvbeam
