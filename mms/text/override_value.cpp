#include "mms/text/override_value.hpp"

#include <toml++/toml.h>

#include <cmath>

namespace tvbeam {

namespace {

/// Nothing where it is a bare word.
std::optional<toml::table> parsed_override(const std::string& value) {
    try {
        return toml::parse("value = " + value);
    } catch (const toml::parse_error&) {
        return std::nullopt;
    }
}

} // namespace

std::optional<double> override_number(const std::string& value) {
    const auto parsed = parsed_override(value);
    const auto number = parsed && (*parsed)["value"].is_number()
                            ? (*parsed)["value"].value<double>()
                            : std::nullopt;
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::string> override_text(const std::string& value) {
    const auto parsed = parsed_override(value);
    return parsed ? (*parsed)["value"].value_exact<std::string>() : value;
}

} // namespace tvbeam
