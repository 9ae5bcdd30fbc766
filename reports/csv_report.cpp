#include "reports/csv_report.hpp"

#include "reports/evolution_section.hpp"
#include "reports/stress_section.hpp"

#include <fmt/format.h>

#include <optional>

namespace tvbeam {

namespace {

std::string quoted(const std::string& field) {
    if (field.find_first_of(",\"\n\r") == std::string::npos)
        return field;
    std::string text = "\"";
    for (const char c : field)
        text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

/// What every run says of itself, before its errors.
std::string run_fields(const RungResult& run) {
    return fmt::format("{},{},{},{},{}", run.rung.elements,
                       1.0 / static_cast<double>(run.rung.elements), run.rung.dt, run.rung.steps,
                       run.status == RunStatus::ok ? "ok" : "failed");
}

std::string number_field(std::optional<double> value) {
    return value ? fmt::format(",{}", *value) : ",";
}

std::optional<double> error_of(const RungResult& run, std::size_t k) {
    return run.errors.empty() ? std::nullopt : std::optional(run.errors[k]);
}

std::string cost_fields(const RungResult& run) {
    return fmt::format(",{},{}\n", run.seconds, quoted(run.reason));
}

std::string ladder_csv(const LadderResult& ladder, const std::optional<PrintedFigures>& printed) {
    const auto has_figures = [&](const std::string& norm) {
        return printed && printed->figures.contains(norm);
    };
    std::string text = "elements,h,dt,steps,status";
    for (const auto& norm : ladder.norms) {
        const std::string& name = norm.norm.name;
        text += "," + name;
        if (has_figures(name))
            text += "," + name + "_printed";
        text += "," + name + "_order";
        if (!norm.predictions.empty())
            text += "," + name + "_predicted";
    }
    text += ",seconds,reason\n";
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        text += run_fields(ladder.rungs[i]);
        for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
            const LadderNorm& norm = ladder.norms[k];
            text += number_field(error_of(ladder.rungs[i], k));
            if (has_figures(norm.norm.name))
                text += number_field(printed->figures.at(norm.norm.name)[i]);
            text += number_field(norm.orders[i]);
            if (!norm.predictions.empty())
                text += number_field(norm.predictions[i]);
        }
        text += cost_fields(ladder.rungs[i]);
    }
    return text;
}

std::string grid_csv(const OrdersResult& orders, const std::vector<Norm>& norms) {
    std::string text = "elements,h,dt,steps,status";
    for (const auto& norm : norms)
        text += "," + norm.name;
    text += ",seconds,reason\n";
    for (const auto& run : orders.runs) {
        text += run_fields(run);
        for (std::size_t k = 0; k < norms.size(); ++k)
            text += number_field(error_of(run, k));
        text += cost_fields(run);
    }
    return text;
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
                text += number_field(error_of(run, norm));
            const auto& timing = result.schemes[k].timings[i];
            text += timing ? fmt::format(",{},{},{},{},{}", timing->min, timing->q1, timing->median,
                                         timing->q3, timing->runs)
                           : ",,,,,";
            text += fmt::format(",{},{},{},{}\n", node_steps(run.rung), run.counters.heat_solves,
                                run.counters.fixed_point_iterations, quoted(run.reason));
        }
    return text;
}

} // namespace

std::string csv_report(const StudyResult& result) {
    if (result.ladder)
        return ladder_csv(*result.ladder, result.scene.ladder->printed);
    if (result.orders)
        return grid_csv(*result.orders, result.scene.orders->norms);
    if (result.work_precision)
        return timed_csv(*result.work_precision, *result.scene.work_precision);
    if (result.evolution)
        return evolution_csv(*result.evolution);
    return stress_csv(*result.stress);
}

} // namespace tvbeam
