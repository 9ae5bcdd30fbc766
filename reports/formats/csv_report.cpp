#include "reports/formats/csv_report.hpp"

#include "reports/document/stress_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace tvbeam {

namespace {

/// A field as RFC 4180 has it.
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
                       name_of(run.status));
}

std::string number_field(std::optional<double> value) {
    return value ? fmt::format(",{}", *value) : ",";
}

/// Empty for what is not finite too.
std::string finite_field(std::optional<double> value) {
    return number_field(value && std::isfinite(*value) ? value : std::nullopt);
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

std::string stress_csv(const StressResult& result) {
    std::string text = "alpha,zeta,dt,elements,steps,g1,g2,load,initial,seed,time,thermal_mass,"
                       "algorithm,outcome,energy,heat_residual,beam_residual,penetration,"
                       "wrong_sign,complementarity,path,error,seconds,reason\n";
    for (const auto& one : result.cases) {
        const StressParameters& p = one.parameters;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", p.alpha, p.zeta, p.dt,
                            p.elements, p.steps, p.stops.lower, p.stops.upper, p.load,
                            name_of(p.initial), p.seed, p.time, name_of(p.thermal_mass),
                            name_of(p.algorithm), name_of(one.outcome));
        const auto check = [&](double StressChecks::*member) {
            return finite_field(one.checks ? std::optional((*one.checks).*member) : std::nullopt);
        };
        text += check(&StressChecks::energy) + check(&StressChecks::heat_residual) +
                check(&StressChecks::beam_residual) + check(&StressChecks::penetration) +
                check(&StressChecks::wrong_sign) + check(&StressChecks::complementarity) +
                finite_field(one.checks ? one.checks->path : std::nullopt) +
                finite_field(one.checks ? one.checks->error : std::nullopt);
        text += fmt::format(",{},{}\n", one.seconds, quoted(one.reason));
    }
    return text;
}

std::string contraction_csv(const ContractionMap& map) {
    std::string text = "alpha,dt,predicted,measured\n";
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i)
        for (Eigen::Index j = 0; j < map.predicted.cols(); ++j)
            text +=
                fmt::format("{},{}{}{}\n", map.block.alpha[static_cast<std::size_t>(j)],
                            map.block.dt[static_cast<std::size_t>(i)],
                            finite_field(map.predicted(i, j)), finite_field(map.measured(i, j)));
    return text;
}

std::string round_off_csv(const RoundOffTable& table) {
    std::string text = "elements,moment,sine,hermite,hermite_predicted,discretisation_error,"
                       "remark\n";
    for (const auto& row : table.rows)
        text += fmt::format("{}{}{}{}{}{},{}\n", row.elements, finite_field(row.moment.value),
                            finite_field(row.sine), finite_field(row.hermite.value),
                            finite_field(row.hermite_predicted),
                            finite_field(row.discretisation_error), quoted(row.remark));
    return text;
}

} // namespace

std::vector<StudyCsv> study_csvs(const StudyResult& result) {
    const Scene& scene = result.scene;
    std::vector<StudyCsv> all;
    if (result.ladder)
        all.push_back({"ladder", ladder_csv(*result.ladder, scene.ladder->printed)});
    if (result.orders)
        all.push_back({"orders", grid_csv(*result.orders, scene.orders->norms)});
    if (result.work_precision)
        all.push_back({"work_precision", timed_csv(*result.work_precision, *scene.work_precision)});
    if (result.evolution)
        all.push_back({"evolution", evolution_csv(*result.evolution)});
    if (result.stress && !result.stress->cases.empty())
        all.push_back({"stress", stress_csv(*result.stress)});
    if (result.stress && result.stress->contraction)
        all.push_back({"contraction", contraction_csv(*result.stress->contraction)});
    if (result.stress && result.stress->roundoff)
        all.push_back({"roundoff", round_off_csv(*result.stress->roundoff)});
    return all;
}

bool is_study_csv(const std::string& name, const std::string& first_line) {
    constexpr std::pair<const char*, const char*> known[] = {
        {"ladder.csv", "elements,h,dt,steps,status,"},
        {"orders.csv", "elements,h,dt,steps,status,"},
        {"work_precision.csv", "scheme,elements,h,dt,steps,status,"},
        {"evolution.csv", "t,"},
        {"stress.csv", "alpha,zeta,dt,elements,steps,"},
        {"contraction.csv", "alpha,dt,predicted,"},
        {"roundoff.csv", "elements,moment,sine,"}};
    return std::any_of(std::begin(known), std::end(known), [&](const auto& one) {
        return name == one.first && first_line.starts_with(one.second);
    });
}

std::string csv_report(const StudyResult& result) {
    const auto all = study_csvs(result);
    return all.empty() ? "" : all.front().text; // none of an interrupted study
}

} // namespace tvbeam
