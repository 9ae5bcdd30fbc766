#include "reports/files/baseline.hpp"

#include "mms/text/input_error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* baseline_schema = "tvbeam-baseline/1";

/// Figures of the size of round-off, which another compiler changes; they want a band of [expect].
bool is_round_off(const std::string& figure) {
    return figure == "beyond_stops" || figure == "period_change" || figure == "moment_floor" ||
           figure.starts_with("hermite_");
}

/// Every error of a result by the name of its run and norm, and every figure of the studies that
/// have figures of their own; NaN: the run failed.
std::map<std::string, double> errors_of(const StudyResult& result) {
    std::map<std::string, double> errors;
    for (const auto& [kind, record] : result.records.entries())
        for (const auto& [name, figure] : kind->figures(record))
            if (!is_round_off(name))
                errors[fmt::format("{}.{}", kind->name(), name)] = figure;
    for (const auto& [series, results] : result.runs())
        for (const auto& run : *results)
            for (std::size_t k = 0; k < series.measures.size(); ++k)
                errors[fmt::format("{}.{}: error at s = {}, dt = {}", series.study,
                                   series.measures[k].name, run.rung.elements, run.rung.dt)] =
                    error_of(run, k).value_or(std::nan(""));
    return errors;
}

} // namespace

std::string baseline_of(const std::vector<StudyResult>& results) {
    Json scenes = Json::object();
    for (const auto& result : results) {
        const std::string& name = result.scene.name;
        if (scenes.contains(name))
            throw InputError({result.scene.file}, "is the second scene that is called " + name +
                                                      "; a baseline goes by their names: rename "
                                                      "one");
        Json errors = Json::object();
        for (const auto& [what, error] : errors_of(result))
            errors[what] = std::isfinite(error) ? Json(error) : Json();
        if (errors.empty())
            throw InputError({result.scene.file},
                             "measures nothing that a baseline could keep; add norms, or a block "
                             "with figures");
        scenes[name] = std::move(errors);
    }
    return Json{{"schema", baseline_schema}, {"scenes", std::move(scenes)}}.dump(2) + "\n";
}

Baseline::Baseline(const std::string& file) : file_(file) {
    std::ifstream stream(file);
    if (!stream)
        throw InputError({file}, "the baseline cannot be read; record one with --record");
    std::ostringstream text;
    text << stream.rdbuf();
    text_ = text.str();
    const Json json = Json::parse(text_, nullptr, false);
    if (json.is_discarded() || !json.is_object() || !json.contains("schema") ||
        json["schema"] != baseline_schema || !json.contains("scenes") ||
        !json["scenes"].is_object())
        throw InputError({file}, std::string("is not a baseline (schema ") + baseline_schema +
                                     "); record one with --record");
}

std::vector<CheckedExpectation> Baseline::check(const StudyResult& result, double tolerance) const {
    const Place place{file_};
    const Json scenes = Json::parse(text_)["scenes"];
    if (!scenes.contains(result.scene.name))
        return {
            {"baseline", "a record of this scene", "none; record it with --record", place, false}};
    const Json& recorded = scenes[result.scene.name];
    std::vector<CheckedExpectation> checked;
    const auto errors = errors_of(result);
    for (const auto& [what, error] : errors) {
        const bool known = recorded.contains(what) && recorded[what].is_number();
        CheckedExpectation one{"baseline: " + what, "a recorded error", fmt::format("{}", error),
                               place, false};
        if (known) {
            const double before = recorded[what];
            one.expected = fmt::format("{} within {}", before, tolerance);
            one.holds = std::abs(error - before) <= tolerance * std::abs(before);
        }
        checked.push_back(one);
    }
    for (const auto& [what, before] : recorded.items())
        if (!errors.contains(what))
            checked.push_back({"baseline: " + what, before.dump(), "this run is not made any more",
                               place, false});
    return checked;
}

} // namespace tvbeam
