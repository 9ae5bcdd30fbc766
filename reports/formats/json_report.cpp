#include "reports/formats/json_report.hpp"

#include "reports/files/provenance.hpp"
#include "reports/formats/evolution_json.hpp"
#include "reports/formats/stress_json.hpp"

#include <nlohmann/json.hpp>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Counters& counters) {
    return {{"steps", counters.steps},
            {"sine_steps", counters.sine_steps},
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

Json json_of(const std::optional<Timing>& timing) {
    if (!timing)
        return {};
    return {{"min", timing->min},
            {"median", timing->median},
            {"q1", timing->q1},
            {"q3", timing->q3},
            {"runs", timing->runs}};
}

Json json_of(std::optional<double> value) {
    return value ? Json(*value) : Json();
}

/// What every run of a study says of itself.
Json json_of(const RungResult& rung) {
    Json entry{{"elements", rung.rung.elements},
               {"dt", rung.rung.dt},
               {"steps", rung.rung.steps},
               {"status", name_of(rung.status)}};
    if (!rung.reason.empty())
        entry["reason"] = rung.reason;
    entry["seconds"] = rung.seconds;
    entry["iterations"] = rung.counters.fixed_point_iterations;
    return entry;
}

Json errors_of(const RungResult& rung, const std::vector<Norm>& norms) {
    Json errors = Json::object();
    for (std::size_t k = 0; k < norms.size(); ++k)
        errors[norms[k].name] = rung.errors.empty() ? Json() : Json(rung.errors[k]);
    return errors;
}

/// The errors of a run, and what of them is uncertain.
void add_errors(Json& entry, const RungResult& rung, const std::vector<Norm>& norms) {
    entry["errors"] = errors_of(rung, norms);
    for (std::size_t k = 0; k < rung.uncertainties.size(); ++k)
        entry["uncertainty"][norms[k].name] = rung.uncertainties[k];
}

Json json_of(const LadderResult& ladder, const LadderBlock& block) {
    Json rungs = Json::array();
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        Json entry = json_of(ladder.rungs[i]);
        add_errors(entry, ladder.rungs[i], block.norms);
        Json orders = Json::object();
        Json printed = Json::object();
        Json predicted = Json::object();
        Json verdict = Json::object();
        Json reason = Json::object();
        for (const auto& norm : ladder.norms) {
            const std::string& name = norm.norm.name;
            orders[name] = json_of(norm.orders[i]);
            if (block.printed && block.printed->figures.contains(name))
                printed[name] = block.printed->figures.at(name)[i];
            if (!norm.predictions.empty())
                predicted[name] = json_of(norm.predictions[i]);
            verdict[name] = name_of(norm.verdicts[i].verdict);
            reason[name] = norm.verdicts[i].reason;
        }
        entry["orders"] = std::move(orders);
        if (!printed.empty())
            entry["printed"] = std::move(printed);
        if (!predicted.empty())
            entry["predicted"] = std::move(predicted);
        entry["verdict"] = std::move(verdict);
        entry["verdict_reason"] = std::move(reason);
        entry["counters"] = json_of(ladder.rungs[i].counters);
        rungs.push_back(std::move(entry));
    }
    Json json{{"final_time", block.final_time}, {"rungs", std::move(rungs)}};
    if (block.printed)
        json["printed_source"] = block.printed->source;
    Json remarks = Json::array();
    if (!ladder.quadrature_remark.empty())
        remarks.push_back(ladder.quadrature_remark);
    if (!ladder.reference_remark.empty())
        remarks.push_back(ladder.reference_remark);
    for (const auto& norm : ladder.norms)
        for (const auto& remark : norm.remarks)
            remarks.push_back(remark);
    json["remarks"] = std::move(remarks);
    return json;
}

Json json_of(const ReferenceResult& reference, const ReferenceBlock& block) {
    Json json{{"elements", block.elements},
              {"dt", block.dt},
              {"richardson", block.richardson},
              {"status", reference.failure.empty() ? "ok" : "failed"},
              {"seconds", reference.seconds}};
    if (!reference.failure.empty())
        json["reason"] = reference.failure;
    return json;
}

Json json_of(const OrdersResult& orders, const OrdersBlock& block) {
    Json norms = Json::object();
    for (const auto& [norm, fit] : orders.norms) {
        if (!fit.holds()) {
            norms[norm] = {{"status", "failed"}, {"reason", fit.failure}};
            continue;
        }
        Json rejected = Json::array();
        for (const auto& record : fit.rejected) {
            const Rung& rung = orders.runs[record.record].rung;
            rejected.push_back(
                {{"elements", rung.elements}, {"dt", rung.dt}, {"reason", record.reason}});
        }
        norms[norm] = {{"status", "ok"},
                       {"p", fit.model.p},
                       {"p_se", fit.p_se},
                       {"p_uncertainty", fit.p_uncertainty()},
                       {"p_determined", fit.p_determined()},
                       {"q", fit.model.q},
                       {"q_se", fit.q_se},
                       {"q_uncertainty", fit.q_uncertainty()},
                       {"q_determined", fit.q_determined()},
                       {"a", fit.model.a},
                       {"b", fit.model.b},
                       {"rho", fit.model.rho},
                       {"rho_se", fit.rho_se},
                       {"rms", fit.rms},
                       {"used", fit.used.size()},
                       {"rejected", std::move(rejected)}};
    }
    Json runs = Json::array();
    for (const auto& run : orders.runs) {
        Json entry = json_of(run);
        add_errors(entry, run, block.norms);
        runs.push_back(std::move(entry));
    }
    Json json{
        {"final_time", block.final_time}, {"norms", std::move(norms)}, {"runs", std::move(runs)}};
    if (orders.corollary)
        json["corollary_constant"] = {{"least", orders.corollary->least},
                                      {"greatest", orders.corollary->greatest},
                                      {"finest", orders.corollary->finest}};
    return json;
}

Json rows_of(const SchemeRuns& scheme, const std::vector<Norm>& norms) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < scheme.runs.size(); ++i) {
        const RungResult& run = scheme.runs[i];
        Json entry = json_of(run);
        entry.erase("iterations"); // among the counters
        add_errors(entry, run, norms);
        entry["seconds"] = json_of(scheme.timings[i]);
        entry["counters"] = json_of(run.counters);
        entry["counters"]["node_steps"] = node_steps(run.rung);
        rows.push_back(std::move(entry));
    }
    return rows;
}

Json json_of(const NormCosts& costs, const std::vector<TimedScheme>& schemes) {
    Json errors = Json::array();
    for (const auto& reached : costs.errors) {
        Json seconds = Json::object();
        for (std::size_t k = 0; k < schemes.size(); ++k)
            seconds[schemes[k].name] = json_of(reached.times[k]);
        Json comparisons = Json::array();
        for (const auto& pair : reached.comparisons)
            comparisons.push_back({{"faster", schemes[pair.faster].name},
                                   {"slower", schemes[pair.slower].name},
                                   {"ratio", pair.times.ratio},
                                   {"lowest", pair.times.lowest},
                                   {"highest", pair.times.highest},
                                   {"told_apart", pair.times.told_apart}});
        errors.push_back({{"error", reached.error},
                          {"target", reached.target},
                          {"seconds", std::move(seconds)},
                          {"comparisons", std::move(comparisons)}});
    }
    return errors;
}

Json json_of(const WorkPrecisionResult& result, const WorkPrecisionBlock& block) {
    Json schemes = Json::array();
    for (std::size_t k = 0; k < block.schemes.size(); ++k)
        schemes.push_back(
            {{"name", block.schemes[k].name}, {"rows", rows_of(result.schemes[k], block.norms)}});
    Json costs = Json::object();
    Json remarks = Json::array();
    if (!result.busy_remark.empty())
        remarks.push_back(result.busy_remark);
    for (const auto& norm : result.norms) {
        costs[norm.norm.name] = json_of(norm, block.schemes);
        for (const auto& remark : norm.remarks)
            remarks.push_back(remark);
    }
    return {{"final_time", block.final_time},
            {"schemes", std::move(schemes)},
            {"time_to_reach", std::move(costs)},
            {"remarks", std::move(remarks)}};
}

Json json_of(const Provenance& p) {
    return {{"version", p.version},    {"commit", p.commit},
            {"compiler", p.compiler},  {"build_type", p.build_type},
            {"flags", p.flags},        {"processor", p.processor},
            {"date", p.date},          {"scene_file", p.scene_file},
            {"overrides", p.overrides}};
}

} // namespace

std::string json_report(const StudyResult& result) {
    Json json{{"schema", "tvbeam-result/1"},
              {"scene", Json::parse(result.scene.json)},
              {"provenance", json_of(provenance_of(result.scene))},
              {"left_out", result.left_out},
              {"remarks", result.remarks},
              {"interrupted", result.interrupted()}};
    if (result.reference)
        json["reference"] = json_of(*result.reference, *result.scene.reference);
    if (result.orders)
        json["orders"] = json_of(*result.orders, *result.scene.orders);
    if (result.ladder)
        json["ladder"] = json_of(*result.ladder, *result.scene.ladder);
    if (result.work_precision)
        json["work_precision"] = json_of(*result.work_precision, *result.scene.work_precision);
    if (result.evolution) {
        json["evolution"] = json_of(result.evolution->run);
        json["evolution"].update(evolution_json(*result.evolution));
        json["evolution"]["counters"] = json_of(result.evolution->run.counters);
    }
    if (result.stress)
        json["stress"] = stress_json(*result.stress);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tvbeam
