#pragma once

#include "studies/runs/run.hpp"
#include "studies/stress/stress.hpp"

#include <nlohmann/json_fwd.hpp>

namespace tvbeam {

// Results of single runs as JSON, for a later attempt at the same scene. Doubles come back as they
// were, to the last bit.

nlohmann::ordered_json kept(const RungResult& result);
nlohmann::ordered_json kept(const StressCase& result);

/// A result again, of the rung and with the measures that the scene asks for. Throws
/// std::invalid_argument, with the reason, where it is none that such a run gives.
RungResult kept_run(const nlohmann::ordered_json& json, const Rung& rung,
                    const std::vector<Measure>& measures);

nlohmann::ordered_json kept(const PrintedDigits& digits);
PrintedDigits kept_digits(const nlohmann::ordered_json& json); ///< throws likewise

/// The same, without its parameters.
StressCase kept_case(const nlohmann::ordered_json& json);

/// The same of rows of [stress.contraction], as wide as its list of alpha, and of
/// [stress.roundoff].
nlohmann::ordered_json kept(const ContractionRow& row);
ContractionRow kept_contraction(const nlohmann::ordered_json& json, std::size_t width);
nlohmann::ordered_json kept(const RoundOffRow& row);
RoundOffRow kept_round_off(const nlohmann::ordered_json& json, std::int64_t elements);

} // namespace tvbeam
