#pragma once

#include "studies/stress/stress.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tvbeam {

/// The block "stress" of a result.
nlohmann::ordered_json stress_json(const StressResult& result);

} // namespace tvbeam
