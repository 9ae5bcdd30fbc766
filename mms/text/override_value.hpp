#pragma once

#include <optional>
#include <string>

namespace tvbeam {

/// The finite number, or the text in quotes or as a bare word, that override_key (toml_reader.hpp)
/// makes of a value; none where it is something else.
std::optional<double> override_number(const std::string& value);
std::optional<std::string> override_text(const std::string& value);

} // namespace tvbeam
