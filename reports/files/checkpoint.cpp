#include "reports/files/checkpoint.hpp"

#include "mms/text/input_error.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/provenance.hpp"
#include "studies/runs/rung.hpp"
#include "studies/stress/stress_case.hpp"

#include <cmath>
#include <fstream>
#include <limits>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds between_writes{500};

/// JSON has no literal for what is not finite.
Json number(double value) {
    if (std::isfinite(value))
        return value;
    return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double number(const Json& json) {
    if (json.is_number())
        return json.get<double>();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto& text = json.get_ref<const std::string&>();
    return text == "nan"   ? std::numeric_limits<double>::quiet_NaN()
           : text == "inf" ? infinity
                           : -infinity;
}

Json optional_number(const std::optional<double>& value) {
    return value ? number(*value) : Json();
}

std::optional<double> optional_number(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(number(json));
}

constexpr std::int64_t Counters::*counters[] = {&Counters::steps,
                                                &Counters::sine_steps,
                                                &Counters::heat_solves,
                                                &Counters::beam_solves,
                                                &Counters::coupling_updates,
                                                &Counters::load_updates,
                                                &Counters::source_evaluations,
                                                &Counters::tip_evaluations,
                                                &Counters::contact_steps,
                                                &Counters::fixed_point_iterations,
                                                &Counters::norm_evaluations,
                                                &Counters::doubles_allocated};
static_assert(sizeof(Counters) == std::size(counters) * sizeof(std::int64_t));

Json json_of(const RungResult& result) {
    Json errors = Json::array();
    for (const double error : result.errors)
        errors.push_back(number(error));
    Json uncertainties = Json::array();
    for (const double part : result.uncertainties)
        uncertainties.push_back(number(part));
    Json counts = Json::array();
    for (const auto counter : counters)
        counts.push_back(result.counters.*counter);
    return {{"elements", result.rung.elements},
            {"steps", result.rung.steps},
            {"dt", number(result.rung.dt)},
            {"failed", result.status != RunStatus::ok},
            {"reason", result.reason},
            {"seconds", result.seconds},
            {"counters", std::move(counts)},
            {"errors", std::move(errors)},
            {"uncertainties", std::move(uncertainties)}};
}

RungResult rung_result(const Json& json) {
    RungResult result;
    result.rung = {json.at("elements"), json.at("steps"), number(json.at("dt"))};
    result.status = json.at("failed") ? RunStatus::failed : RunStatus::ok;
    result.reason = json.at("reason");
    result.seconds = json.at("seconds");
    for (std::size_t k = 0; k < std::size(counters); ++k)
        result.counters.*counters[k] = json.at("counters").at(k);
    for (const auto& error : json.at("errors"))
        result.errors.push_back(number(error));
    for (const auto& part : json.at("uncertainties"))
        result.uncertainties.push_back(number(part));
    return result;
}

constexpr double StressChecks::*checks[] = {
    &StressChecks::energy,      &StressChecks::heat_residual, &StressChecks::beam_residual,
    &StressChecks::penetration, &StressChecks::wrong_sign,    &StressChecks::complementarity,
    &StressChecks::path_limit};

Json json_of(const StressCase& result) {
    Json json{{"outcome", static_cast<int>(result.outcome)},
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
    return json;
}

StressCase stress_case(const Json& json) {
    StressCase result;
    result.outcome = static_cast<Outcome>(json.at("outcome").get<int>());
    result.reason = json.at("reason");
    result.seconds = json.at("seconds");
    if (!json.contains("checks"))
        return result;
    StressChecks& made = result.checks.emplace();
    for (std::size_t k = 0; k < std::size(checks); ++k)
        made.*checks[k] = number(json.at("checks").at(k));
    made.path = optional_number(json.at("path"));
    made.path_skipped = json.at("path_skipped");
    made.error = optional_number(json.at("error"));
    made.error_skipped = json.at("error_skipped");
    return result;
}

/// What the results depend on.
Json identity_of(const Scene& scene) {
    Json identity{{"version", TVBEAM_VERSION},
                  {"compiler", TVBEAM_COMPILER},
                  {"build_type", TVBEAM_BUILD_TYPE},
                  {"commit", provenance_of(scene).commit},
                  {"scene", Json::parse(scene.json)}};
    for (const char* words : {"title", "expect", "report", "short"})
        identity["scene"].erase(words); // no result depends on them
    if (const auto* solution = std::get_if<Solution>(&scene.problem)) {
        Json& text = identity["solution"] = Json::array();
        for (const auto& parameter : solution->parameters)
            text.push_back(parameter.name + " = " + parameter.value.text());
        for (const auto& phase : solution->phases)
            text.push_back({phase.until ? phase.until->text() : "", phase.theta.text(),
                            phase.u.text(), phase.sigma ? phase.sigma->text() : ""});
    }
    return identity;
}

} // namespace

Checkpoint::Checkpoint(const std::filesystem::path& directory, const Scene& scene, bool resume)
    : file_(directory / "unfinished.json") {
    const OutputFile writable(file_);
    Json identity = identity_of(scene);
    // What an attempt that was killed while it wrote has left behind.
    for (const auto& entry : std::filesystem::directory_iterator(directory))
        if (entry.path().filename().string().starts_with("unfinished.json."))
            std::filesystem::remove(entry.path());
    if (std::filesystem::exists(file_)) {
        if (!resume)
            throw InputError({file_.string()},
                             "holds results of an attempt that was cut short; go on with it by "
                             "--resume, or remove the file");
        read(identity);
    }
    if (content_.is_null())
        content_ = {{"schema", "tvbeam-unfinished/1"}, {"of", std::move(identity)}};
}

void Checkpoint::read(const Json& identity) {
    const std::string advice = "; remove the file to begin anew";
    try {
        content_ = Json::parse(std::ifstream(file_));
        if (content_.at("of") != identity)
            throw InputError({file_.string()},
                             "holds results of another scene, or of another build of tvbeam, and "
                             "the two do not fit together" +
                                 advice);
        if (content_.contains("runs"))
            for (const auto& [study, entries] : content_.at("runs").items())
                for (const auto& entry : entries) {
                    // That it can be read is found out now, not after hours.
                    if (study == "stress")
                        stress_case(entry);
                    else
                        rung_result(entry);
                    ++found_;
                }
    } catch (const nlohmann::json::exception& error) {
        throw InputError({file_.string()},
                         "is not what tvbeam wrote: " + std::string(error.what()) + advice);
    }
}

std::optional<Json> Checkpoint::find_entry(const std::string& study, std::size_t index) {
    const std::scoped_lock lock(mutex_);
    const std::string key = std::to_string(index);
    if (!content_.contains("runs") || !content_["runs"].contains(study) ||
        !content_["runs"][study].contains(key))
        return std::nullopt;
    return content_["runs"][study][key];
}

void Checkpoint::add_entry(const std::string& study, std::size_t index, Json entry) {
    const std::scoped_lock lock(mutex_);
    content_["runs"][study][std::to_string(index)] = std::move(entry);
    changed_ = true;
    if (std::chrono::steady_clock::now() - written_ >= between_writes)
        write();
}

std::optional<RungResult> Checkpoint::find(const std::string& study, std::size_t index) {
    const auto entry = find_entry(study, index);
    return entry ? std::optional(rung_result(*entry)) : std::nullopt;
}

void Checkpoint::add(const std::string& study, std::size_t index, const RungResult& result) {
    add_entry(study, index, json_of(result));
}

std::optional<StressCase> Checkpoint::find_case(std::size_t index) {
    const auto entry = find_entry("stress", index);
    return entry ? std::optional(stress_case(*entry)) : std::nullopt;
}

void Checkpoint::add_case(std::size_t index, const StressCase& result) {
    add_entry("stress", index, json_of(result));
}

void Checkpoint::write() {
    if (!changed_)
        return;
    OutputFile(file_).commit(content_.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    changed_ = false;
    written_ = std::chrono::steady_clock::now();
}

void Checkpoint::remove() {
    std::filesystem::remove(file_);
    changed_ = false;
}

} // namespace tvbeam
