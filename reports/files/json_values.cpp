#include "reports/files/json_values.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;
using LeavesOut = std::function<bool(const std::string&)>;

/// What tells an element of a list from the others: its level, its name, the value of a sweep; else
/// its place.
std::string element_name(const Json& element, bool of_sweep, std::size_t place) {
    std::string name;
    if (element.is_object())
        for (const auto& [key, word] : std::array<std::pair<const char*, const char*>, 3>{
                 {{of_sweep ? "value" : "name", ""}, {"elements", "s = "}, {"dt", "dt = "}}})
            if (element.contains(key) && (element[key].is_number() || element[key].is_string()))
                name += (name.empty() ? " " : ", ") + std::string(word) + element[key].dump();
    return name.empty() ? fmt::format(" {}", place + 1) : name + ":";
}

std::string inside(const std::string& path, const std::string& key) {
    std::string name = path;
    if (!path.empty())
        name += path.ends_with(':') ? ' ' : '.';
    return name += key;
}

void collect(const Json& json, const std::string& path, const LeavesOut& leaves_out,
             JsonValues& values) {
    if (json.is_object()) {
        for (const auto& [key, value] : json.items())
            if (!leaves_out(key))
                collect(value, inside(path, key), leaves_out, values);
    } else if (json.is_array()) {
        std::set<std::string> names; // runs that are repeated have one
        for (std::size_t i = 0; i < json.size(); ++i) {
            std::string name = path + element_name(json[i], path == "rows", i);
            if (!names.insert(name).second)
                name += fmt::format(" ({})", i + 1);
            collect(json[i], name, leaves_out, values);
        }
    } else {
        values[path] = json;
    }
}

} // namespace

JsonValues json_values(const Json& json, const LeavesOut& leaves_out) {
    JsonValues values;
    collect(json, "", leaves_out, values);
    return values;
}

} // namespace tvbeam
