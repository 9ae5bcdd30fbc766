#include "reports/json_report.hpp"

#include <nlohmann/json.hpp>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Counters& counters) {
    return {{"steps", counters.steps},
            {"heat_solves", counters.heat_solves},
            {"beam_solves", counters.beam_solves},
            {"coupling_updates", counters.coupling_updates},
            {"load_updates", counters.load_updates},
            {"source_evaluations", counters.source_evaluations},
            {"tip_evaluations", counters.tip_evaluations},
            {"contact_steps", counters.contact_steps},
            {"fixed_point_iterations", counters.fixed_point_iterations},
            {"norm_evaluations", counters.norm_evaluations},
            {"doubles_allocated", counters.doubles_allocated}};
}

Json json_of(const LadderResult& ladder, const LadderBlock& block) {
    Json rungs = Json::array();
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        const RungResult& rung = ladder.rungs[i];
        Json errors = Json::object();
        Json orders = Json::object();
        Json printed = Json::object();
        for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
            const std::string& norm = ladder.norms[k];
            errors[norm] = rung.errors.empty() ? Json() : Json(rung.errors[k]);
            orders[norm] = rung.orders[k] ? Json(*rung.orders[k]) : Json();
            if (block.printed && block.printed->figures.contains(norm))
                printed[norm] = block.printed->figures.at(norm)[i];
        }
        Json entry{{"elements", rung.rung.elements},
                   {"dt", rung.rung.dt},
                   {"steps", rung.rung.steps},
                   {"status", rung.status == RunStatus::ok ? "ok" : "failed"}};
        if (!rung.reason.empty())
            entry["reason"] = rung.reason;
        entry["seconds"] = rung.seconds;
        entry["iterations"] = rung.counters.fixed_point_iterations;
        entry["errors"] = std::move(errors);
        entry["orders"] = std::move(orders);
        if (!printed.empty())
            entry["printed"] = std::move(printed);
        entry["counters"] = json_of(rung.counters);
        rungs.push_back(std::move(entry));
    }
    Json json{
        {"final_time", block.final_time}, {"norms", ladder.norms}, {"rungs", std::move(rungs)}};
    if (block.printed)
        json["printed_source"] = block.printed->source;
    json["remarks"] = ladder.remarks;
    return json;
}

} // namespace

std::string json_report(const StudyResult& result) {
    Json json{{"schema", "tvbeam-result/1"},
              {"scene", Json::parse(result.scene.json)},
              {"provenance",
               {{"version", TVBEAM_VERSION},
                {"compiler", TVBEAM_COMPILER},
                {"build_type", TVBEAM_BUILD_TYPE},
                {"scene_file", result.scene.file}}},
              {"left_out", result.left_out}};
    if (result.ladder)
        json["ladder"] = json_of(*result.ladder, *result.scene.ladder);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tvbeam
