#pragma once

#include "studies/runs/run.hpp"
#include "studies/scene/until.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What every run of a study says of itself in JSON, null for what it does not have; and its errors
/// and values by name, its counters.
nlohmann::ordered_json run_json(const RungResult& run);
void add_errors(nlohmann::ordered_json& entry, const RungResult& run,
                const std::vector<Measure>& measures);
nlohmann::ordered_json counters_json(const RungResult& run);

/// How `until` ended, and what is not known: ended_by, not_known.
void add_ending(nlohmann::ordered_json& json, const Refined& refined);

/// A number, or null where there is none or it is not finite.
nlohmann::ordered_json number_json(std::optional<double> value);

/// A text as a field of RFC 4180, which no terminal obeys and no spreadsheet computes: before = + -
/// and @ stands a '.
std::string quoted(const std::string& field);

/// The first columns of a run, without a comma at the end; their names.
std::string run_fields(const RungResult& run);
inline constexpr const char* run_columns = "elements,h,dt,steps,status";

/// A comma and a number, or nothing where there is none; finite_field: or it is not finite.
std::string number_field(std::optional<double> value);
std::string finite_field(std::optional<double> value);

/// A comma and the k-th error or value of a run: nan of one that failed, as who reads the table
/// must not take it for one that was not made; nothing of one that was not.
std::string measure_field(const RungResult& run, std::size_t k);

/// The last columns of a run, seconds and reason.
std::string cost_fields(const RungResult& run);

} // namespace tvbeam
