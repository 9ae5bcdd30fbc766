#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tvbeam {

/// JSON as it is written to a file or a terminal: indented, a line end behind it, what is no UTF-8
/// replaced, and the control characters that JSON may hold as they are (DEL, C1) escaped, because
/// terminals obey them.
std::string json_text(const nlohmann::ordered_json& json);

/// The same in one line, without its end.
std::string json_line(const nlohmann::ordered_json& json);

} // namespace tvbeam
