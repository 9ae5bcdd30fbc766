#include "reports/document/stress_section.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/stress/stress.hpp"
#include "studies/table_row.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

/// Each is about 4 kB of memory while it is written.
constexpr std::size_t most_in_json = 20'000;

Json stop(double value) {
    return std::isfinite(value) ? Json(value) : Json(value < 0.0 ? "-inf" : "inf");
}

Json json_of(const StressParameters& p) {
    return {{"alpha", p.alpha},
            {"zeta", p.zeta},
            {"dt", p.dt},
            {"elements", p.elements},
            {"steps", p.steps},
            {"stops", {stop(p.stops.lower), stop(p.stops.upper)}},
            {"theta_A", p.theta_A},
            {"load", p.load},
            {"initial", name_of(p.initial)},
            {"seed", p.seed},
            {"time", p.time},
            {"thermal_mass", name_of(p.thermal_mass)},
            {"algorithm", name_of(p.algorithm)}};
}

Json json_of(const StressChecks& checks) {
    Json json{{"energy", number_json(checks.energy)},
              {"heat_residual", number_json(checks.heat_residual)},
              {"beam_residual", number_json(checks.beam_residual)},
              {"penetration", number_json(checks.penetration)},
              {"wrong_sign", number_json(checks.wrong_sign)},
              {"complementarity", number_json(checks.complementarity)},
              {"initial_state", number_json(checks.initial)},
              {"allowance", number_json(checks.allowance)},
              {"path", number_json(checks.path)},
              {"path_limit", number_json(checks.path_limit)}};
    if (!checks.path)
        json["path_skipped"] = checks.path_skipped;
    json["error"] = number_json(checks.error);
    if (!checks.error)
        json["error_skipped"] = checks.error_skipped;
    json["order_defect"] = number_json(checks.order_defect);
    return json;
}

Json json_of(const StressCase& one) {
    Json json{{"parameters", json_of(one.parameters)}, {"outcome", name_of(one.outcome)}};
    json["reason"] = one.reason.empty() ? Json() : Json(one.reason);
    json["checks"] = one.checks ? json_of(*one.checks) : Json();
    json["seconds"] = one.seconds;
    return json;
}

Json json_of(const ContractionMap& map) {
    Json points = Json::array();
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i)
        for (Eigen::Index j = 0; j < map.predicted.cols(); ++j)
            points.push_back({{"alpha", map.block.alpha[static_cast<std::size_t>(j)]},
                              {"dt", map.block.dt[static_cast<std::size_t>(i)]},
                              {"predicted", number_json(map.predicted(i, j))},
                              {"measured", number_json(map.measured(i, j))},
                              {"greatest", number_json(map.greatest(i, j))}});
    return {{"zeta", map.block.zeta},
            {"elements", map.block.elements},
            {"refused", map.refused()},
            {"points", std::move(points)}};
}

Json json_of(const RoundOffTable& table) {
    Json rows = Json::array();
    for (const auto& row : table.rows) {
        rows.push_back({{"elements", row.elements},
                        {"moment", number_json(row.moment.value)},
                        {"sine", number_json(row.sine)},
                        {"hermite", number_json(row.hermite.value)},
                        {"hermite_predicted", number_json(row.hermite_predicted)},
                        {"discretisation_error", number_json(row.discretisation_error)}});
        if (!row.moment.reason.empty())
            rows.back()["moment_stopped"] = row.moment.reason;
        if (!row.hermite.reason.empty())
            rows.back()["hermite_stopped"] = row.hermite.reason;
        if (!row.remark.empty())
            rows.back()["remark"] = row.remark;
    }
    return rows;
}

Json json_of(const StressResult& result) {
    const StressCases& all = result.cases;
    Json json{{"certified", all.count(Outcome::certified)},
              {"refused", all.count(Outcome::refused)},
              {"stopped", all.count(Outcome::stopped)},
              {"failed", all.count(Outcome::failed)}};
    json["cases"] = Json::array();
    if (all.size() <= most_in_json) {
        all.visit([&json](const StressCase& one) { json["cases"].push_back(json_of(one)); });
    } else {
        json["cases_left_out"] = fmt::format("{} cases are more than {}: their rows stand in "
                                             "stress.csv, which --csv writes, or [report] "
                                             "where its files hold \"csv\"",
                                             all.size(), most_in_json);
    }
    if (result.contraction)
        json["contraction"] = json_of(*result.contraction);
    if (result.roundoff)
        json["roundoff"] = json_of(*result.roundoff);
    for (const auto& [study, there, all] : result.reached)
        json["reached"][study] = {{"there", there}, {"all", all}};
    return json;
}

std::string csv_row(const StressCase& one) {
    const StressParameters& p = one.parameters;
    std::string text = fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", p.alpha, p.zeta, p.dt, p.elements, p.steps,
        p.stops.lower, p.stops.upper, p.theta_A, p.load, name_of(p.initial), p.seed, p.time,
        name_of(p.thermal_mass), name_of(p.algorithm), name_of(one.outcome));
    const auto check = [&](double StressChecks::*member) {
        return finite_field(one.checks ? std::optional((*one.checks).*member) : std::nullopt);
    };
    text += check(&StressChecks::energy) + check(&StressChecks::heat_residual) +
            check(&StressChecks::beam_residual) + check(&StressChecks::penetration) +
            check(&StressChecks::wrong_sign) + check(&StressChecks::complementarity) +
            check(&StressChecks::initial) +
            finite_field(one.checks ? one.checks->path : std::nullopt) +
            finite_field(one.checks ? one.checks->error : std::nullopt) +
            finite_field(one.checks ? one.checks->order_defect : std::nullopt);
    return text + fmt::format(",{},{}\n", one.seconds, quoted(one.reason));
}

LongText stress_csv(const StressCases& cases) {
    return LongText([cases](const LongText::Sink& sink) {
        std::string rows =
            "alpha,zeta,dt,elements,steps,g1,g2,theta_A,load,initial,seed,time,thermal_mass,"
            "algorithm,outcome,energy,heat_residual,beam_residual,penetration,"
            "wrong_sign,complementarity,initial_state,path,error,order_defect,seconds,reason\n";
        constexpr std::size_t at_a_time = 65'536; // bytes
        cases.visit([&](const StressCase& one) {
            rows += csv_row(one);
            if (rows.size() > at_a_time) {
                sink(rows);
                rows.clear();
            }
        });
        sink(rows);
    });
}

std::string contraction_csv(const ContractionMap& map) {
    std::string text = "alpha,dt,predicted,measured,greatest\n";
    for (Eigen::Index i = 0; i < map.predicted.rows(); ++i)
        for (Eigen::Index j = 0; j < map.predicted.cols(); ++j)
            text += fmt::format("{},{}{}{}{}\n", map.block.alpha[static_cast<std::size_t>(j)],
                                map.block.dt[static_cast<std::size_t>(i)],
                                finite_field(map.predicted(i, j)), finite_field(map.measured(i, j)),
                                finite_field(map.greatest(i, j)));
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

struct StressReport final : StudyReport {
    std::string study() const override { return "stress"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return stress_sections(*result.get<StressResult>());
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<StressResult>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        const StressResult& stress = *result.get<StressResult>();
        std::vector<StudyCsv> all;
        if (!stress.cases.empty())
            all.push_back({study(), stress_csv(stress.cases)});
        if (stress.contraction)
            all.push_back({"contraction", contraction_csv(*stress.contraction)});
        if (stress.roundoff)
            all.push_back({"roundoff", round_off_csv(*stress.roundoff)});
        return all;
    }
    std::vector<Plot> plots(const StudyResult& result) const override {
        std::vector<Plot> all;
        for (const auto& plots : {stress_plots, contraction_plots, round_off_plots})
            for (auto& plot : plots(result))
                all.push_back(std::move(plot));
        return all;
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), "alpha,zeta,dt,elements,steps,"},
                {"contraction", "alpha,dt,predicted,"},
                {"roundoff", "elements,moment,sine,"}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, StressReport>();

} // namespace tvbeam
