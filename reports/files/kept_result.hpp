#pragma once

#include "studies/runs/run.hpp"
#include "studies/stress/stress_case.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tvbeam {

// Results of single runs as JSON, for a later attempt at the same scene. Doubles come back as they
// were, to the last bit.

nlohmann::ordered_json kept(const RungResult& result);
nlohmann::ordered_json kept(const StressCase& result);

/// A result again, of the rung and with so many norms as the scene asks for. Throws
/// std::invalid_argument, with the reason, where it is none that such a run gives.
RungResult kept_run(const nlohmann::ordered_json& json, const Rung& rung, std::size_t norms);

/// The same, without its parameters.
StressCase kept_case(const nlohmann::ordered_json& json);

} // namespace tvbeam
