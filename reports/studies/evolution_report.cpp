#include "reports/document/evolution_section.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/table_row.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

/// JSON has no literal for what is not a number.
Json numbers_json(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values)
        list.push_back(number_json(value));
    return list;
}

Json json_of(const EvolutionResult& result) {
    Json probes = Json::object();
    Json exact = Json::object();
    for (const auto& probe : result.probes) {
        probes[probe.name] = numbers_json(probe.values);
        if (!probe.exact.empty())
            exact[probe.name] = numbers_json(probe.exact);
    }
    Json events = Json::array();
    for (const auto& event : result.events)
        events.push_back({{"kind", name_of(event.kind)},
                          {"stop", name_of(event.stop)},
                          {"t", event.t},
                          {"beyond", event.beyond}});
    Json periods = Json::array();
    for (const auto& period : result.periods) {
        Json changes = Json::object();
        for (std::size_t k = 0; k < result.probes.size(); ++k)
            changes[result.probes[k].name] = period.changes[k];
        periods.push_back({{"end", period.end}, {"changes", std::move(changes)}});
    }
    Json json = run_json(result.run);
    json["t"] = numbers_json(result.t);
    json["probes"] = std::move(probes);
    if (!exact.empty())
        json["exact"] = std::move(exact);
    json["events"] = std::move(events);
    if (result.presses_within_steps())
        json["presses_within_steps"] = true;
    json["beyond_stops"] = result.beyond_stops;
    if (!result.periods.empty())
        json["periods"] = std::move(periods);
    json["counters"] = counters_json(result.run);
    return json;
}

/// Every sample: t, the probes, and behind each that has one its exact value.
std::string evolution_csv(const EvolutionResult& result) {
    std::string text = "t";
    for (const auto& probe : result.probes)
        text += "," + probe.name + (probe.exact.empty() ? "" : "," + probe.name + "_exact");
    text += "\n";
    for (std::size_t i = 0; i < result.t.size(); ++i) {
        text += fmt::format("{}", result.t[i]);
        for (const auto& probe : result.probes) {
            text += finite_field(probe.values[i]);
            if (!probe.exact.empty())
                text += finite_field(probe.exact[i]);
        }
        text += "\n";
    }
    return text;
}

} // namespace

struct EvolutionReport final : StudyReport {
    std::string study() const override { return "evolution"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return {evolution_section(*result.get<EvolutionResult>(), result.scene)};
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<EvolutionResult>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        return {{study(), evolution_csv(*result.get<EvolutionResult>())}};
    }
    std::vector<Plot> plots(const StudyResult& result) const override {
        return evolution_plots(result);
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), "t,"}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, EvolutionReport>();

} // namespace tvbeam
