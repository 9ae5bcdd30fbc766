#include "reports/files/baseline.hpp"

#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/visible_text.hpp"
#include "reports/document/json_text.hpp"
#include "reports/files/held_values.hpp"
#include "reports/files/said_result.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <system_error>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* baseline_schema = "tvbeam-baseline/1";
constexpr std::size_t largest_baseline = 64 << 20; // bytes

/// Of values within each other, above what a baseline has.
constexpr int deepest_baseline = 24;

/// Of what a scene says, beside its figures, which have a study before a dot.
constexpr const char* said_key = "said";

/// Figures of the size of round-off, which another compiler changes; they want a band of [expect].
bool is_round_off(const std::string& study, const std::string& figure) {
    if (study == "stress" && (figure.ends_with(".least") || figure.ends_with(".greatest")))
        return true;
    return figure == "beyond_stops" || figure.ends_with("period_change") ||
           figure == "moment_floor" || figure.starts_with("hermite_");
}

/// Figures that are round-off where both are so small: of tips on a rigid stop, and of values in
/// time.
bool are_zero(const std::string& what, double one, double other) {
    constexpr double round_off = 1e-13;
    return (what.find(".beyond.") != std::string::npos || what.ends_with(".error")) &&
           std::max(std::abs(one), std::abs(other)) < round_off;
}

/// Errors of a scheme that is exact for the solution.
bool are_rounding(const BaselineEntry& entry, const std::string& what, double one, double other) {
    const auto most = entry.rounding.find(what);
    return most != entry.rounding.end() && std::max(std::abs(one), std::abs(other)) <= most->second;
}

/// A number; null: there is none; "inf" or "-inf".
Json figure_json(double figure) {
    if (std::isfinite(figure))
        return figure;
    return std::isnan(figure) ? Json() : Json(figure > 0.0 ? "inf" : "-inf");
}

/// What the errors of measure k are below, where its study found them to be rounding.
std::optional<double> rounding_of(const StudyResult& result, const std::vector<RungResult>& runs,
                                  std::size_t k) {
    if (const auto* ladder = result.get<LadderResult>();
        ladder != nullptr && &runs == &ladder->rungs && k < ladder->norms.size())
        return ladder->norms[k].rounding;
    if (const auto* orders = result.get<OrdersResult>();
        orders != nullptr && &runs == &orders->runs && k < orders->norms.size())
        return orders->norms[k].rounding;
    return std::nullopt;
}

/// Of a figure of a table, without its numbers: the column and the names of the widths.
std::string series_of(const std::string& figure) {
    const std::string equals = " = ";
    std::string series;
    std::size_t at = 0;
    for (std::size_t found = 0; (found = figure.find(equals, at)) != std::string::npos;) {
        series += figure.substr(at, found - at);
        at = std::min(figure.find(' ', found + equals.size()), figure.size());
    }
    const auto rest = figure.substr(at);
    return series + (rest.starts_with(" (") ? "" : rest);
}

/// The folder that the files of a baseline are relative to.
std::filesystem::path folder_of(const std::string& baseline) {
    std::error_code error;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(baseline, error), error)
        .parent_path();
}

/// A file as a baseline names it, wherever both are moved together; empty: not at all.
std::string file_beside(const std::string& baseline, const std::string& file) {
    std::error_code error;
    if (baseline.empty() || !std::filesystem::is_regular_file(file, error))
        return {};
    return std::filesystem::weakly_canonical(file, error)
        .lexically_relative(folder_of(baseline))
        .string();
}

/// Levels and measurements that are repeated, in their order.
std::string another_name(const std::string& what,
                         const std::function<bool(const std::string&)>& is_taken) {
    std::string name = what;
    for (int count = 2; is_taken(name); ++count)
        name = fmt::format("{} ({})", what, count);
    return name;
}

} // namespace

void require_recordable(const Scene& scene) {
    for (const auto& [kind, block] : scene.blocks.entries())
        if (const Until* until = kind->until(block);
            until != nullptr && until->seconds && until->adds)
            throw InputError({scene.file},
                             fmt::format("its {0}.until.seconds ends the {0} by the clock, so that "
                                         "the next run may have other runs than a baseline: give "
                                         "until its other budget alone",
                                         kind->name()));
}

BaselineEntry baseline_entry(const StudyResult& result) {
    BaselineEntry entry{result.scene.name, {result.scene.file}, {}};
    entry.file = result.scene.file;
    for (const auto& [kind, record] : result.records.entries())
        for (const auto& [name, figure] : kind->figures(record))
            if (!is_round_off(kind->name(), name))
                entry.figures[fmt::format("{}.{}", kind->name(), name)] = figure;
    for (const auto& [series, results] : result.runs())
        for (const auto& run : *results)
            for (std::size_t k = 0; k < series.measures.size(); ++k) {
                const std::string name = another_name(
                    fmt::format("{}.{}: {} at {}", series.study, series.measures[k].name,
                                series.measures[k].is_value ? "value" : "error",
                                run.rung.name([](double dt) { return fmt::format("{}", dt); })),
                    [&](const auto& taken) { return entry.figures.contains(taken); });
                entry.figures[name] = error_of(run, k).value_or(std::nan(""));
                if (const auto most = rounding_of(result, *results, k))
                    entry.rounding[name] = *most;
            }
    return entry;
}

BaselineEntry whole_entry(const StudyResult& result,
                          const std::vector<CheckedExpectation>& checked) {
    BaselineEntry entry = baseline_entry(result);
    entry.said = json_line(said_by(result, checked));
    return entry;
}

BaselineEntry baseline_entry(const DataAnalysis& analysis) {
    std::map<std::string, double> figures;
    std::set<std::string> not_made;
    for (const auto& column : analysis.columns)
        for (std::size_t row = 0; row < analysis.rows(); ++row) {
            std::string what = column.name + ":";
            for (const auto& width : analysis.widths)
                what += fmt::format(" {} = {}", width.name, width.numbers[row]);
            const std::string name = another_name(what, [&](const auto& taken) {
                return figures.contains(taken) || not_made.contains(taken);
            });
            if (!column.missing.empty() && column.missing[row])
                not_made.insert(name);
            else
                figures[name] = column.numbers[row];
        }
    // However the path of the table is spelled.
    std::string name = std::filesystem::path(analysis.name).lexically_normal().string();
    for (const auto& chosen : analysis.chosen)
        name += " --where " + chosen;
    return {.name = std::move(name),
            .place = {analysis.name},
            .figures = std::move(figures),
            .not_made = std::move(not_made),
            .file = analysis.name,
            .is_table = true};
}

std::optional<Baseline> earlier_baseline(const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error) ||
        std::filesystem::file_size(file, error) == 0)
        return std::nullopt;
    return Baseline(file);
}

void require_another_name(std::set<std::string>& names, const std::string& name,
                          const Place& place) {
    if (!names.insert(name).second)
        throw InputError(place, "is the second scene that is called " + name +
                                    "; a baseline goes by their names: rename one");
}

std::string baseline_of(const std::vector<BaselineEntry>& entries, const std::string& file) {
    Json scenes = Json::object();
    Json files = Json::object();
    std::set<std::string> names;
    const auto earlier = earlier_baseline(file);
    if (earlier) {
        const Json recorded = Json::parse(file_text(file, largest_baseline));
        scenes = recorded["scenes"];
        files = recorded.value("files", files);
    }
    for (const auto& entry : entries) {
        require_another_name(names, entry.name, entry.place);
        if (earlier)
            earlier->require_room(entry);
        Json errors = Json::object();
        for (const auto& [what, error] : entry.figures)
            errors[what] = figure_json(error);
        if (!entry.said.empty())
            errors[said_key] = Json::parse(entry.said);
        if (errors.empty())
            throw InputError(entry.place,
                             "measures nothing that a baseline could keep; add norms, or a block "
                             "with figures");
        scenes[entry.name] = std::move(errors);
        files.erase(entry.name);
        if (const std::string beside = file_beside(file, entry.file); !beside.empty())
            files[entry.name] = beside;
    }
    // A line a scene: its history shows which has changed.
    const auto lines = [](const Json& object) {
        std::string text;
        for (const auto& [name, kept] : object.items())
            text += (text.empty() ? "\n" : ",\n") + json_line(Json(name)) + ": " + json_line(kept);
        return text + "\n}";
    };
    return fmt::format("{{\"schema\": \"{}\", \"scenes\": {{", baseline_schema) + lines(scenes) +
           (files.empty() ? "" : ", \"files\": {" + lines(files)) + "}\n";
}

void Baseline::require_room(const BaselineEntry& entry) const {
    if (entry.said.empty() && has_said(entry.name))
        throw InputError({file_}, "has all that the result of '" + entry.name +
                                      "' says, and a record of its numbers would take the place "
                                      "of that; add --whole, or record in another file");
    require_same_file(entry);
    if (entry.is_table)
        require_same_columns(entry);
}

void Baseline::require_same_file(const BaselineEntry& entry) const {
    const auto recorded = files_.find(entry.name);
    if (recorded == files_.end())
        return;
    const auto other = (folder_of(file_) / recorded->second).lexically_normal();
    std::error_code error;
    const bool is_another = std::filesystem::is_regular_file(other, error) &&
                            !std::filesystem::equivalent(other, entry.file, error) && !error;
    if (is_another)
        throw InputError({entry.file}, "would take the place of " + other.string() + " in " +
                                           file_ + ", where both are called '" + entry.name +
                                           "'; rename one, or record in another file");
}

void Baseline::require_same_columns(const BaselineEntry& entry) const {
    const auto recorded = scenes_.find(entry.name);
    if (recorded == scenes_.end())
        return;
    std::set<std::string> series;
    for (const auto& [what, figure] : entry.figures)
        series.insert(series_of(what));
    for (const auto& what : entry.not_made)
        series.insert(series_of(what));
    for (const auto& [what, figure] : recorded->second)
        if (!series.contains(series_of(what)))
            throw InputError({file_}, "has '" + what + "' of '" + entry.name +
                                          "', and this record, without that column or width, "
                                          "would take its place; analyse both in one call, or "
                                          "record in another file");
}

Baseline::Baseline(const std::string& file) : file_(file) {
    const std::string text = file_text(file, largest_baseline);
    const auto require = [&](bool holds) {
        if (!holds)
            throw InputError({file}, std::string("is not a baseline (schema ") + baseline_schema +
                                         "); record one with --record");
    };
    // Its names are sorted: of many thousands each is found at once. A baseline has few levels, and
    // a deep value would be copied and written by recursion.
    std::array<std::set<std::string>, deepest_baseline + 2> names; // by depth
    const auto looked_at = [&](int depth, nlohmann::json::parse_event_t event,
                               const nlohmann::json& value) {
        require(depth <= deepest_baseline);
        const auto within = static_cast<std::size_t>(depth);
        if (event == nlohmann::json::parse_event_t::object_start)
            names.at(within + 1).clear();
        if (event == nlohmann::json::parse_event_t::key && !names.at(within).insert(value).second)
            throw InputError({file}, "has '" + value.get<std::string>() +
                                         "' more than once; which is meant? Remove the other");
        return true;
    };
    const auto json = nlohmann::json::parse(text, looked_at, false);
    require(!json.is_discarded() && json.is_object() && json.contains("schema") &&
            json["schema"] == baseline_schema && json.contains("scenes") &&
            json["scenes"].is_object() && (!json.contains("files") || json["files"].is_object()));
    if (json.contains("files"))
        for (const auto& [scene, place] : json["files"].items()) {
            require(place.is_string());
            files_[scene] = place;
        }
    for (const auto& [scene, figures] : json["scenes"].items()) {
        auto& recorded = scenes_[scene];
        for (const auto& [what, figure] : figures.items())
            if (what == said_key) {
                require(figure.is_object());
                said_[scene] = figure.dump(-1, ' ', false, Json::error_handler_t::replace);
            } else
                recorded[what] = {figure.is_number() ? std::optional<double>(figure) : std::nullopt,
                                  figure.dump(-1, ' ', false, Json::error_handler_t::replace)};
    }
}

std::vector<CheckedExpectation> Baseline::check(const BaselineEntry& entry,
                                                double tolerance) const {
    const Place place{file_};
    const auto scene = scenes_.find(entry.name);
    if (scene == scenes_.end()) {
        std::string names;
        for (const auto& [name, figures] : scenes_)
            names += (names.empty() ? "" : ", ") + visible(name);
        constexpr std::size_t most = 200;
        return {{"baseline", "a record of '" + visible(entry.name) + "', by this name",
                 names.empty()
                     ? "none"
                     : "those of " + names.substr(0, most) + (names.size() > most ? "…" : ""),
                 place, false}};
    }
    const auto& recorded = scene->second;
    std::vector<CheckedExpectation> checked;
    const auto& errors = entry.figures;
    for (const auto& [what, error] : errors) {
        const auto found = recorded.find(what);
        CheckedExpectation one{"baseline: " + what, "a recorded error", fmt::format("{}", error),
                               place, false};
        if (found != recorded.end() && found->second.number) {
            const double before = *found->second.number;
            one.expected = fmt::format("{} within {}", before, tolerance);
            one.holds = std::abs(error - before) <= tolerance * std::abs(before) ||
                        are_zero(what, error, before) || are_rounding(entry, what, error, before);
        } else if (found != recorded.end() && std::isfinite(error)) {
            one.expected = "none, as recorded";
        } else if (found != recorded.end()) {
            // A field that is missing, or infinite, and was.
            const auto text = [](const std::string& json) {
                return json == "null" ? "none" : json;
            };
            const std::string now = figure_json(error).dump();
            one.expected = text(found->second.text);
            one.found = text(now);
            one.holds = now == found->second.text;
        }
        checked.push_back(one);
    }
    for (const auto& [what, before] : recorded)
        if (!errors.contains(what) && !(before.text == "null" && entry.not_made.contains(what)))
            checked.push_back(
                {"baseline: " + what, before.text, "nothing of the kind", place, false});
    if (const auto said = said_.find(entry.name); said != said_.end()) {
        const Json now = entry.said.empty() ? Json::object() : Json::parse(entry.said);
        const auto differences = held_values(Json::parse(said->second), now, tolerance);
        if (differences.empty())
            checked.push_back(
                {"baseline: what it says", "as recorded", "as recorded", place, true});
        for (const auto& one : differences)
            checked.push_back({"baseline: " + one.what, one.first.value_or("nothing of the kind"),
                               one.second.value_or("it is not said any more"), place, false});
    }
    return checked;
}

} // namespace tvbeam
