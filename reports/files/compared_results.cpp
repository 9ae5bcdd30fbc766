#include "reports/files/compared_results.hpp"

#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "reports/files/json_values.hpp"
#include "reports/files/solver_runs.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_result = std::size_t{1} << 30U; // bytes
constexpr int deepest_result = 40;                            // values within each other

constexpr std::array schemas{"tvbeam-result/1", "tvbeam-analysis/1", "tvbeam-sweep/1"};

/// Different from run to run of the same. No number of a solver is called so.
bool is_time(const std::string& key) {
    return key == "seconds" || key.starts_with("seconds to "); // of a sweep of a race
}

bool is_nothing(const std::string& /*key*/) {
    return false;
}

/// The list that an object has under a key; where it has none, one without elements.
Json::array_t list_in(const Json& json, const char* key) {
    const bool has = json.is_object() && json.contains(key) && json[key].is_array();
    return has ? json[key].get<Json::array_t>() : Json::array_t();
}

/// Changes each element of such a list.
void for_each_in(Json& json, const char* key, const std::function<void(Json&)>& change) {
    if (json.is_object() && json.contains(key) && json[key].is_array())
        for (auto& element : json[key])
            change(element);
}

/// Gives an object the name "h = 0.1, dt = 0.05", of the values of these keys.
void name_by(Json& named, const Json& values, const std::vector<std::string>& keys) {
    std::string name;
    for (const auto& key : keys)
        if (values.contains(key))
            name += (name.empty() ? "" : ", ") + key + " = " + values[key].dump();
    if (named.is_object() && !name.empty())
        named["name"] = name;
}

std::vector<std::string> keys_of(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items())
        keys.push_back(key);
    return keys;
}

/// Rows of a table go by their widths, cases by their parameters, what an evolution recorded by its
/// times: by their places others would be compared where one result has more of them.
void name_elements(Json& json) {
    std::vector<std::string> sizes;
    for (const auto& size : list_in(json, "sizes"))
        if (size.is_string() && size != "elements" && size != "dt") // by which all elements go
            sizes.push_back(size);
    for_each_in(json, "columns", [&](Json& column) {
        for_each_in(column, "rows", [&](Json& row) { name_by(row, row, sizes); });
    });
    if (json.contains("stress"))
        for_each_in(json["stress"], "cases", [](Json& one) {
            if (one.is_object() && one.contains("parameters") && one["parameters"].is_object())
                name_by(one, one["parameters"], keys_of(one["parameters"]));
        });
    if (!json.contains("evolution"))
        return;
    Json& evolution = json["evolution"];
    const auto times = list_in(evolution, "t");
    if (times.empty())
        return;
    evolution.erase("t");
    for (const char* series : {"probes", "exact"})
        if (evolution.contains(series))
            for (auto& values : evolution[series]) {
                if (!values.is_array())
                    continue;
                Json by_time = Json::object();
                for (std::size_t i = 0; i < times.size() && i < values.size(); ++i)
                    by_time["t = " + times[i].dump()] = values[i];
                values = by_time;
            }
}

/// Of a race, what is said of times: which scheme is sooner by how much, and a busy machine.
void leave_out_races(Json& json) {
    const auto race = json.find("work_precision");
    if (race == json.end() || !race->is_object())
        return;
    if (const auto remarks = race->find("remarks"); remarks != race->end() && remarks->is_array())
        remarks->erase(std::remove_if(remarks->begin(), remarks->end(),
                                      [](const Json& remark) {
                                          const auto text = remark.is_string()
                                                                ? remark.get<std::string>()
                                                                : std::string();
                                          return text.starts_with("The machine was busy") ||
                                                 text.find("the clock shows 0 s") !=
                                                     std::string::npos;
                                      }),
                       remarks->end());
    if (const auto costs = race->find("time_to_reach"); costs != race->end() && costs->is_object())
        for (auto& [norm, errors] : costs->items())
            for (auto& reached : errors)
                if (reached.is_object())
                    reached.erase("comparisons");
}

Json result_in(const std::string& name) {
    std::error_code error;
    const auto file = std::filesystem::is_directory(name, error)
                          ? (std::filesystem::path(name) / "result.json").string()
                          : name;
    bool shallow = true;
    const auto depth = [&](int level, nlohmann::json::parse_event_t /*event*/, Json& /*value*/) {
        shallow = shallow && level <= deepest_result;
        return shallow;
    };
    Json json = Json::parse(file_text(file, largest_result), depth, false);
    const bool is_result = shallow && json.is_object() && json.contains("schema") &&
                           std::ranges::find(schemas, json["schema"]) != schemas.end();
    if (!is_result)
        throw InputError({file}, "is not a result of tvbeam; name a result.json, or the directory "
                                 "of --out that holds one");
    return json;
}

/// The values of a sweep; its scene has the first alone.
Json swept_values(const Json& json, const std::string& name) {
    const Json rows = json.value("rows", Json());
    if (!rows.is_array() ||
        !std::ranges::all_of(rows, [](const Json& row) { return row.is_object(); }))
        throw InputError(
            {name}, "is no result of a sweep: its rows are " +
                        rows.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40) +
                        "; they are a list of objects, one a value");
    Json values = Json::array();
    for (const auto& row : rows)
        values.push_back(row.value("value", Json()));
    return values;
}

std::optional<double> relative_difference(const Json& a, const Json& b) {
    if (!a.is_number() || !b.is_number())
        return std::nullopt;
    const double first = a;
    const double second = b;
    const double size = std::max(std::abs(first), std::abs(second));
    return size == 0.0 ? 0.0 : std::abs(second - first) / size;
}

/// Whether both say that the tip is on a rigid stop: by how far it is beyond, but for rounding, at
/// "beyond" of an event, "beyond_stops" of a run, or "beyond.1" of a contact in a sweep.
bool are_on_a_stop(const std::string& what, const Json& a, const Json& b) {
    const std::size_t at = what.find_last_of(". ", what.find("beyond"));
    const std::string key = what.substr(at + 1);
    // An error of a solver may be called so.
    const bool is_beyond =
        what.starts_with("evolution.")
            ? key == "beyond" || key == "beyond_stops"
            : what.starts_with("rows ") && (key == "beyond_stops" || key.starts_with("beyond."));
    return is_beyond && a.is_number() && b.is_number() &&
           std::max(std::abs(a.get<double>()), std::abs(b.get<double>())) <= zero_value;
}

/// Sentences whose words are the same to the letter, and whose numbers to the tolerance.
bool same_sentence(const std::string& first, const std::string& second, double tolerance) {
    std::size_t i = 0;
    std::size_t j = 0;
    const auto number = [](const std::string& text, std::size_t& at) {
        double value = 0.0;
        const char* end = text.data() + text.size();
        at = static_cast<std::size_t>(std::from_chars(text.data() + at, end, value).ptr -
                                      text.data());
        return value;
    };
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    while (i < first.size() && j < second.size()) {
        if (is_digit(first[i]) && is_digit(second[j])) {
            const double a = number(first, i);
            const double b = number(second, j);
            if (!(std::abs(b - a) <= tolerance * std::max(a, b)))
                return false;
        } else if (first[i++] != second[j++]) {
            return false;
        }
    }
    return i == first.size() && j == second.size();
}

/// A number that differs by this part, with the digits that show it and two more.
std::string number_text(double value, double relative) {
    constexpr double fewest = 6.0;
    constexpr double all = 17.0;
    const double digits = relative > 0.0 ? 3.0 - std::floor(std::log10(relative)) : all;
    return fmt::format("{:.{}g}", value, static_cast<int>(std::clamp(digits, fewest, all)));
}

std::vector<ResultDifference> differences(const JsonValues& first, const JsonValues& second,
                                          double tolerance, std::size_t& equal) {
    std::vector<ResultDifference> found;
    const auto text = [](const Json& value, std::optional<double> relative = std::nullopt) {
        return relative && value.is_number_float()
                   ? number_text(value, *relative)
                   : value.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    for (const auto& [what, value] : first) {
        const auto other = second.find(what);
        if (other == second.end()) {
            found.push_back({what, text(value), std::nullopt, std::nullopt});
            continue;
        }
        const auto relative = relative_difference(value, other->second);
        const bool is_sentence = value.is_string() && other->second.is_string();
        if (other->second == value || relative.value_or(2.0) <= tolerance ||
            are_on_a_stop(what, value, other->second) ||
            (tolerance > 0.0 && is_sentence && same_sentence(value, other->second, tolerance)))
            ++equal;
        else
            found.push_back({what, text(value, relative), text(other->second, relative), relative});
    }
    for (const auto& [what, value] : second)
        if (!first.contains(what))
            found.push_back({what, std::nullopt, text(value), std::nullopt});
    return found;
}

} // namespace

ComparedResults compare_results(const std::string& first, const std::string& second,
                                double tolerance) {
    ComparedResults compared;
    std::array<JsonValues, 2> scenes;
    std::array<JsonValues, 2> results;
    const std::array<const std::string*, 2> names{&first, &second};
    for (std::size_t i = 0; i < names.size(); ++i) {
        Json json = result_in(*names.at(i));
        if (json.contains("scene"))
            scenes.at(i) = json_values(json["scene"], is_nothing);
        // What is expected is no figure of a result.
        for (const char* key : {"scene", "schema", "provenance", "check"})
            json.erase(key);
        if (const Json swept = json.value("key", Json()); swept.is_string())
            scenes.at(i)[swept] = swept_values(json, *names.at(i));
        leave_out_races(json);
        if (const auto stress = json.find("stress"); stress != json.end() && stress->is_object() &&
                                                     stress->contains("cases_left_out") &&
                                                     (*stress)["cases_left_out"].is_string())
            compared.not_compared = {"stress: " + (*stress)["cases_left_out"].get<std::string>()};
        name_elements(json);
        json.erase("file"); // of a table that was analysed
        if (auto remarks = json.find("remarks"); remarks != json.end() && remarks->is_array())
            remarks->erase(std::remove_if(remarks->begin(), remarks->end(),
                                          [](const Json& remark) {
                                              return remark.is_string() &&
                                                     SolverRuns::is_remark(remark);
                                          }),
                           remarks->end());
        // Of a table that was analysed all numbers are its own, also those of a width "seconds".
        results.at(i) = json_values(json, json.contains("sizes") ? is_nothing : is_time);
    }
    std::size_t in_scene = 0;
    compared.scene = differences(scenes[0], scenes[1], 0.0, in_scene);
    compared.results = differences(results[0], results[1], tolerance, compared.equal);
    // What only one has stands last.
    std::stable_sort(compared.results.begin(), compared.results.end(),
                     [](const auto& a, const auto& b) {
                         return a.relative.value_or(-1.0) > b.relative.value_or(-1.0);
                     });
    return compared;
}

} // namespace tvbeam
