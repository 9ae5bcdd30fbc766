#include "reports/studies/run_fields.hpp"

#include "mms/text/visible_text.hpp"
#include "studies/gates/expectation.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tvbeam {

using Json = nlohmann::ordered_json;

Json run_json(const RungResult& run) {
    const Rung& rung = run.rung;
    Json json{{"elements", rung.has_mesh() ? Json(rung.elements) : Json()},
              {"dt", number_json(rung.step())},
              {"steps", rung.steps > 0 ? Json(rung.steps) : Json()},
              {"status", name_of(run.status)}};
    if (!run.reason.empty())
        json["reason"] = run.reason;
    json["seconds"] = run.seconds;
    json["iterations"] = run.count("fixed_point_iterations");
    return json;
}

void add_errors(Json& entry, const RungResult& run, const std::vector<Measure>& measures) {
    entry["errors"] = Json::object();
    for (std::size_t k = 0; k < measures.size(); ++k)
        entry[measures[k].is_value ? "values" : "errors"][measures[k].name] =
            run.errors.empty() ? Json() : Json(run.errors[k]);
    for (std::size_t k = 0; k < run.uncertainties.size(); ++k)
        entry["uncertainty"][measures[k].name] = run.uncertainties[k];
}

Json counters_json(const RungResult& run) {
    Json counters = Json::object();
    for (const auto& [name, value] : run.counters)
        counters[name] = value;
    return counters;
}

void add_ending(Json& json, const Refined& refined) {
    json["ended_by"] = name_of(refined.end);
    json["not_known"] = refined.open;
}

Json number_json(std::optional<double> value) {
    return value && std::isfinite(*value) ? Json(*value) : Json();
}

std::string quoted(const std::string& given) {
    // A spreadsheet would compute what begins so.
    const bool is_formula = given.find_first_of("=+-@\t\r") == 0;
    std::string field = (is_formula ? "'" : "") + visible(given);
    if (field.find_first_of(",\"\n\r") == std::string::npos)
        return field;
    std::string text = "\"";
    for (const char c : field)
        text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

std::string run_fields(const RungResult& run) {
    const auto field = [](bool is, auto number) { return is ? fmt::format("{}", number) : ""; };
    const Rung& rung = run.rung;
    return fmt::format("{},{},{},{},{}", field(rung.has_mesh(), rung.elements),
                       field(rung.has_mesh(), rung.h()), field(rung.has_steps(), rung.dt),
                       field(rung.steps > 0, rung.steps), name_of(run.status));
}

std::string number_field(std::optional<double> value) {
    return value ? fmt::format(",{}", *value) : ",";
}

std::string finite_field(std::optional<double> value) {
    return number_field(value && std::isfinite(*value) ? value : std::nullopt);
}

std::string measure_field(const RungResult& run, std::size_t k) {
    return run.status == RungStatus::failed ? ",nan" : number_field(error_of(run, k));
}

std::string cost_fields(const RungResult& run) {
    return fmt::format(",{},{}\n", run.seconds, quoted(run.reason));
}

} // namespace tvbeam
