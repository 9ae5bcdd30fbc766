#include "reports/formats/evolution_json.hpp"

#include "reports/document/evolution_section.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no literal for what is not a number.
Json numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values)
        list.push_back(std::isfinite(value) ? Json(value) : Json());
    return list;
}

} // namespace

Json evolution_json(const EvolutionResult& result) {
    Json probes = Json::object();
    Json exact = Json::object();
    for (const auto& probe : result.probes) {
        probes[probe.name] = numbers(probe.values);
        if (!probe.exact.empty())
            exact[probe.name] = numbers(probe.exact);
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
    Json json{{"t", numbers(result.t)}, {"probes", std::move(probes)}};
    if (!exact.empty())
        json["exact"] = std::move(exact);
    json["events"] = std::move(events);
    json["beyond_stops"] = result.beyond_stops;
    if (!result.periods.empty())
        json["periods"] = std::move(periods);
    return json;
}

} // namespace tvbeam
