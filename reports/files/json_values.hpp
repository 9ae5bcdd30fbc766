#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <string>

namespace tvbeam {

/// Every number, text, truth value and null of a JSON value by where it stands, as
/// "ladder.rungs s = 10, dt = 0.001: errors.theta_L2L2_sq".
using JsonValues = std::map<std::string, nlohmann::ordered_json>;

/// Below this a number is as good as zero: that the tip is beyond a rigid stop by so little,
/// rounding.
inline constexpr double zero_value = 1e-14;

/// leaves_out: keys whose values are not wanted.
JsonValues json_values(const nlohmann::ordered_json& json,
                       const std::function<bool(const std::string& key)>& leaves_out);

} // namespace tvbeam
