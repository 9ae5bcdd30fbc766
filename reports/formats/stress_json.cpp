#include "reports/formats/stress_json.hpp"

#include "reports/document/stress_section.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no literal for what is not finite.
Json number(std::optional<double> value) {
    return value && std::isfinite(*value) ? Json(*value) : Json();
}

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
            {"load", p.load},
            {"initial", name_of(p.initial)},
            {"seed", p.seed},
            {"time", p.time},
            {"thermal_mass", name_of(p.thermal_mass)},
            {"algorithm", name_of(p.algorithm)}};
}

Json json_of(const StressChecks& checks) {
    Json json{{"energy", number(checks.energy)},
              {"heat_residual", number(checks.heat_residual)},
              {"beam_residual", number(checks.beam_residual)},
              {"penetration", number(checks.penetration)},
              {"wrong_sign", number(checks.wrong_sign)},
              {"complementarity", number(checks.complementarity)},
              {"path", number(checks.path)},
              {"path_limit", number(checks.path_limit)}};
    if (!checks.path)
        json["path_skipped"] = checks.path_skipped;
    json["error"] = number(checks.error);
    if (!checks.error)
        json["error_skipped"] = checks.error_skipped;
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
                              {"predicted", number(map.predicted(i, j))},
                              {"measured", number(map.measured(i, j))}});
    return {{"zeta", map.block.zeta},
            {"elements", map.block.elements},
            {"refused", map.refused()},
            {"points", std::move(points)}};
}

Json json_of(const RoundOffTable& table) {
    Json rows = Json::array();
    for (const auto& row : table.rows) {
        rows.push_back({{"elements", row.elements},
                        {"moment", number(row.moment.value)},
                        {"sine", number(row.sine)},
                        {"hermite", number(row.hermite.value)},
                        {"hermite_predicted", number(row.hermite_predicted)},
                        {"discretisation_error", number(row.discretisation_error)}});
        if (!row.moment.reason.empty())
            rows.back()["moment_stopped"] = row.moment.reason;
        if (!row.hermite.reason.empty())
            rows.back()["hermite_stopped"] = row.hermite.reason;
        if (!row.remark.empty())
            rows.back()["remark"] = row.remark;
    }
    return rows;
}

} // namespace

nlohmann::ordered_json stress_json(const StressResult& result) {
    Json cases = Json::array();
    for (const auto& one : result.cases)
        cases.push_back(json_of(one));
    Json json{{"certified", result.count(Outcome::certified)},
              {"refused", result.count(Outcome::refused)},
              {"stopped", result.count(Outcome::stopped)},
              {"failed", result.count(Outcome::failed)},
              {"cases", std::move(cases)}};
    if (result.contraction)
        json["contraction"] = json_of(*result.contraction);
    if (result.roundoff)
        json["roundoff"] = json_of(*result.roundoff);
    return json;
}

} // namespace tvbeam
