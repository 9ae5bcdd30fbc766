#include "reports/document/json_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvbeam {

namespace {

/// indent: of each level; -1: all in one line.
std::string escaped_text(const nlohmann::ordered_json& json, int indent) {
    const std::string text =
        json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    std::string escaped;
    escaped.reserve(text.size() + 1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        if (byte == 0x7FU) {
            escaped += "\\u007f";
        } else if (byte == 0xC2U && next < 0xA0U) { // U+0080 to U+009F
            escaped += fmt::format("\\u{:04x}", next);
            ++i;
        } else {
            escaped += text[i];
        }
    }
    return escaped;
}

} // namespace

std::string json_text(const nlohmann::ordered_json& json) {
    return escaped_text(json, 2) + "\n";
}

std::string json_line(const nlohmann::ordered_json& json) {
    return escaped_text(json, -1);
}

} // namespace tvbeam
