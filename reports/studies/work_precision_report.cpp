#include "reports/document/work_precision_section.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/table_row.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

Json json_of(const std::optional<Timing>& timing) {
    if (!timing)
        return {};
    return {{"min", timing->min},
            {"median", timing->median},
            {"q1", timing->q1},
            {"q3", timing->q3},
            {"runs", timing->runs}};
}

Json rows_of(const SchemeRuns& scheme, const std::vector<Measure>& norms) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < scheme.runs.size(); ++i) {
        const RungResult& run = scheme.runs[i];
        Json entry = run_json(run);
        entry.erase("iterations"); // among the counters
        add_errors(entry, run, norms);
        entry["seconds"] = json_of(scheme.timings[i]);
        entry["counters"] = counters_json(run);
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
                                   {"told_apart", pair.times.distinguishable}});
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
    return {{"final_time", block.final_time > 0.0 ? Json(block.final_time) : Json()},
            {"schemes", std::move(schemes)},
            {"time_to_reach", std::move(costs)},
            {"remarks", std::move(remarks)}};
}

std::string timed_csv(const WorkPrecisionResult& result, const WorkPrecisionBlock& block) {
    std::string text = "scheme,elements,h,dt,steps,status";
    for (const auto& norm : block.norms)
        text += "," + norm.name;
    text += ",seconds_min,seconds_q1,seconds_median,seconds_q3,runs,node_steps,heat_solves,"
            "fixed_point_iterations,reason\n";
    for (std::size_t k = 0; k < block.schemes.size(); ++k)
        for (std::size_t i = 0; i < result.schemes[k].runs.size(); ++i) {
            const RungResult& run = result.schemes[k].runs[i];
            text += quoted(block.schemes[k].name) + "," + run_fields(run);
            for (std::size_t norm = 0; norm < block.norms.size(); ++norm)
                text += measure_field(run, norm);
            const auto& timing = result.schemes[k].timings[i];
            text += timing ? fmt::format(",{},{},{},{},{}", timing->min, timing->q1, timing->median,
                                         timing->q3, timing->runs)
                           : ",,,,,";
            text += fmt::format(",{},{},{},{}\n", node_steps(run.rung), run.count("heat_solves"),
                                run.count("fixed_point_iterations"), quoted(run.reason));
        }
    return text;
}

} // namespace

struct WorkPrecisionReport final : StudyReport {
    std::string study() const override { return "work_precision"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return {work_precision_section(*result.get<WorkPrecisionResult>(),
                                       *result.scene.get<WorkPrecisionBlock>())};
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<WorkPrecisionResult>(), *result.scene.get<WorkPrecisionBlock>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        return {{study(), timed_csv(*result.get<WorkPrecisionResult>(),
                                    *result.scene.get<WorkPrecisionBlock>())}};
    }
    std::vector<Plot> plots(const StudyResult& result) const override {
        return run_time_plots(result);
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), std::string("scheme,") + run_columns}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, WorkPrecisionReport>();

} // namespace tvbeam
