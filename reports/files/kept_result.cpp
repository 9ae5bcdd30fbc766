#include "reports/files/kept_result.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

void require(bool holds, const std::string& what) {
    if (!holds)
        throw std::invalid_argument(what);
}

const Json& member(const Json& json, const char* name) {
    require(json.is_object() && json.contains(name), std::string(name) + " is missing");
    return json[name];
}

/// JSON has no literal for what is not finite.
Json number(double value) {
    if (std::isfinite(value))
        return value;
    return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double number(const Json& json, const std::string& what) {
    if (json.is_number())
        return json.get<double>();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [text, value] : {std::pair{"nan", std::numeric_limits<double>::quiet_NaN()},
                                      {"inf", infinity},
                                      {"-inf", -infinity}})
        if (json == text)
            return value;
    throw std::invalid_argument(what + " is not a number");
}

Json optional_number(const std::optional<double>& value) {
    return value ? number(*value) : Json();
}

std::optional<double> optional_number(const Json& json, const char* name) {
    const Json& value = member(json, name);
    return value.is_null() ? std::nullopt : std::optional(number(value, name));
}

std::string text(const Json& json, const char* name) {
    require(member(json, name).is_string(), std::string(name) + " is not a text");
    return json[name];
}

double seconds(const Json& json) {
    const double value = number(member(json, "seconds"), "seconds");
    require(std::isfinite(value) && value >= 0.0, "seconds are not a time");
    return value;
}

std::int64_t count(const Json& json, const std::string& what) {
    require(json.is_number_integer() && json >= 0 &&
                json <= std::numeric_limits<std::int64_t>::max(),
            what + " is not a number of things");
    return json;
}

constexpr double StressChecks::*checks[] = {
    &StressChecks::energy,      &StressChecks::heat_residual, &StressChecks::beam_residual,
    &StressChecks::penetration, &StressChecks::wrong_sign,    &StressChecks::complementarity,
    &StressChecks::initial,     &StressChecks::allowance,     &StressChecks::path_limit};

} // namespace

nlohmann::ordered_json kept(const RungResult& result) {
    Json errors = Json::array();
    for (const double error : result.errors)
        errors.push_back(number(error));
    Json uncertainties = Json::array();
    for (const double part : result.uncertainties)
        uncertainties.push_back(number(part));
    Json counts = Json::object();
    for (const auto& [name, value] : result.counters)
        counts[name] = value;
    Json json{{"elements", result.rung.elements},
              {"steps", result.rung.steps},
              {"dt", number(result.rung.dt)},
              {"failed", result.status != RungStatus::ok},
              {"reason", result.reason},
              {"seconds", result.seconds},
              {"counters", std::move(counts)},
              {"errors", std::move(errors)},
              {"uncertainties", std::move(uncertainties)}};
    if (result.wall_clock)
        json["wall_clock"] = *result.wall_clock;
    if (result.has_kink)
        json["has_kink"] = true;
    for (const auto& digits : result.printed)
        json["printed"].push_back(kept(digits));
    return json;
}

nlohmann::ordered_json kept(const PrintedDigits& digits) {
    return {{"significant", digits.significant},
            {"last_place", digits.last_place},
            {"is_zero", digits.is_zero}};
}

PrintedDigits kept_digits(const nlohmann::ordered_json& json) {
    require(member(json, "last_place").is_number_integer() && member(json, "is_zero").is_boolean(),
            "what was printed is no digits");
    return {.significant = static_cast<int>(count(member(json, "significant"), "significant")),
            .last_place = json["last_place"],
            .is_zero = json["is_zero"]};
}

RungResult kept_run(const nlohmann::ordered_json& json, const Rung& rung,
                    const std::vector<Measure>& measures) {
    RungResult result;
    result.rung = {count(member(json, "elements"), "elements"),
                   count(member(json, "steps"), "steps"), number(member(json, "dt"), "dt")};
    require(result.rung.elements == rung.elements && result.rung.steps == rung.steps &&
                result.rung.dt == rung.dt,
            "elements, steps and dt are not those of the scene");
    require(member(json, "failed").is_boolean(), "failed is neither true nor false");
    const bool failed = json["failed"];
    result.status = failed ? RungStatus::failed : RungStatus::ok;
    result.reason = text(json, "reason");
    require(failed != result.reason.empty(), "reason does not belong to failed");
    result.seconds = seconds(json);
    if (json.contains("wall_clock"))
        result.wall_clock = number(json["wall_clock"], "wall_clock");
    result.has_kink = json.value("has_kink", false);
    const Json& counts = member(json, "counters");
    require(counts.is_object(), "counters have no names");
    for (const auto& [name, value] : counts.items())
        result.counters.push_back({name, count(value, "a counter")});
    require(result.count("steps") <= rung.steps &&
                result.count("sine_steps") <= result.count("steps"),
            "counters are of more steps than the run has");
    const Json& errors = member(json, "errors");
    require(errors.is_array() && errors.size() == (failed ? 0 : measures.size()),
            "errors are not one a norm of a run that did not fail");
    for (const auto& error : errors) {
        const bool is_value = measures[result.errors.size()].is_value;
        result.errors.push_back(number(error, "an error"));
        require(std::isfinite(result.errors.back()) && (is_value || result.errors.back() >= 0.0),
                "an error is not a norm");
    }
    const Json& uncertainties = member(json, "uncertainties");
    require(uncertainties.is_array() &&
                (uncertainties.empty() || uncertainties.size() == result.errors.size()),
            "uncertainties are not one an error");
    for (const auto& part : uncertainties) {
        result.uncertainties.push_back(number(part, "an uncertainty"));
        require(result.uncertainties.back() >= 0.0, "an uncertainty is not a part");
    }
    if (json.contains("printed"))
        for (const auto& digits : json["printed"])
            result.printed.push_back(kept_digits(digits));
    require(result.printed.empty() || result.printed.size() == result.errors.size(),
            "what was printed is not one an error");
    return result;
}

nlohmann::ordered_json kept(const StressCase& result) {
    Json json{{"outcome", name_of(result.outcome)},
              {"reason", result.reason},
              {"seconds", result.seconds}};
    if (!result.checks)
        return json;
    Json values = Json::array();
    for (const auto check : checks)
        values.push_back(number((*result.checks).*check));
    json["checks"] = std::move(values);
    json["path"] = optional_number(result.checks->path);
    json["path_skipped"] = result.checks->path_skipped;
    json["error"] = optional_number(result.checks->error);
    json["error_skipped"] = result.checks->error_skipped;
    json["order_defect"] = optional_number(result.checks->order_defect);
    return json;
}

StressCase kept_case(const nlohmann::ordered_json& json) {
    StressCase result;
    const std::string outcome = text(json, "outcome");
    bool known = false;
    for (const auto one : {Outcome::certified, Outcome::refused, Outcome::stopped, Outcome::failed})
        if (name_of(one) == outcome) {
            result.outcome = one;
            known = true;
        }
    require(known, "outcome is none");
    result.reason = text(json, "reason");
    require((result.outcome == Outcome::certified) == result.reason.empty(),
            "reason does not belong to the outcome");
    result.seconds = seconds(json);
    const bool checked = result.outcome == Outcome::certified || result.outcome == Outcome::failed;
    require(json.contains("checks") == checked, "checks do not belong to the outcome");
    if (!checked)
        return result;
    const Json& values = json["checks"];
    require(values.is_array() && values.size() == std::size(checks),
            "checks are not as many as there are");
    StressChecks& made = result.checks.emplace();
    for (std::size_t k = 0; k < std::size(checks); ++k)
        made.*checks[k] = number(values[k], "a check");
    made.path = optional_number(json, "path");
    made.path_skipped = text(json, "path_skipped");
    made.error = optional_number(json, "error");
    made.error_skipped = text(json, "error_skipped");
    made.order_defect = optional_number(json, "order_defect");
    return result;
}

namespace {

Json numbers(const std::vector<double>& values) {
    Json json = Json::array();
    for (const double value : values)
        json.push_back(number(value));
    return json;
}

std::vector<double> numbers(const Json& json, const char* name) {
    require(member(json, name).is_array(), std::string(name) + " is no list");
    std::vector<double> values;
    for (const auto& value : json[name])
        values.push_back(number(value, name));
    return values;
}

Json floor_json(const Floor& floor) {
    return {{"value", optional_number(floor.value)}, {"reason", floor.reason}};
}

Floor floor_of(const Json& json, const char* name) {
    const Json& floor = member(json, name);
    return {optional_number(floor, "value"), text(floor, "reason")};
}

} // namespace

nlohmann::ordered_json kept(const ContractionRow& row) {
    return {{"predicted", numbers(row.predicted)},
            {"measured", numbers(row.measured)},
            {"greatest", numbers(row.greatest)}};
}

ContractionRow kept_contraction(const nlohmann::ordered_json& json, std::size_t width) {
    ContractionRow row{numbers(json, "predicted"), numbers(json, "measured"),
                       numbers(json, "greatest")};
    require(row.predicted.size() == width && row.measured.size() == width &&
                row.greatest.size() == width,
            "contractions are not one an alpha");
    return row;
}

nlohmann::ordered_json kept(const RoundOffRow& row) {
    return {{"elements", row.elements},
            {"moment", floor_json(row.moment)},
            {"sine", optional_number(row.sine)},
            {"hermite", floor_json(row.hermite)},
            {"hermite_predicted", number(row.hermite_predicted)},
            {"discretisation_error", number(row.discretisation_error)},
            {"remark", row.remark}};
}

RoundOffRow kept_round_off(const nlohmann::ordered_json& json, std::int64_t elements) {
    RoundOffRow row{.elements = count(member(json, "elements"), "elements"),
                    .moment = floor_of(json, "moment"),
                    .sine = optional_number(json, "sine"),
                    .hermite = floor_of(json, "hermite"),
                    .hermite_predicted = number(member(json, "hermite_predicted"), "a prediction"),
                    .discretisation_error =
                        number(member(json, "discretisation_error"), "an error"),
                    .remark = text(json, "remark")};
    require(row.elements == elements, "elements are not those of the scene");
    return row;
}

} // namespace tvbeam
