#include "reports/studies/fit_fields.hpp"

#include "reports/studies/run_fields.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace tvbeam {

using Json = nlohmann::ordered_json;

Json fit_json(const TwoTermFit& fit, const std::function<Json(std::size_t)>& widths_of) {
    if (!fit.holds())
        return {{"status", "failed"}, {"reason", fit.failure}};
    Json rejected = Json::array();
    for (const auto& record : fit.rejected) {
        rejected.push_back(widths_of(record.record));
        rejected.back()["reason"] = record.reason;
    }
    // What is not determined is no number.
    const auto known = [](const OrderInterval& order, double value) {
        return number_json(order.determined ? std::optional(value) : std::nullopt);
    };
    const auto size = [&known, has_sizes = fit.has_sizes()](const OrderInterval& order,
                                                            double value) {
        return has_sizes ? known(order, value) : Json();
    };
    const auto& model = fit.model;
    Json json{{"status", "ok"},
              {"p", known(fit.p, model.p)},
              {"p_se", known(fit.p, fit.p_se)},
              {"p_uncertainty", known(fit.p, fit.p_uncertainty())},
              {"p_determined", fit.p_determined()},
              {"q", known(fit.q, model.q)},
              {"q_se", known(fit.q, fit.q_se)},
              {"q_uncertainty", known(fit.q, fit.q_uncertainty())},
              {"q_determined", fit.q_determined()},
              {"a", size(fit.p, model.a)},
              {"b", size(fit.q, model.b)},
              {"a_uncertainty", size(fit.p, fit.a_uncertainty)},
              {"b_uncertainty", size(fit.q, fit.b_uncertainty)},
              {"rho", number_json(fit.is_known() ? std::optional(model.rho) : std::nullopt)},
              {"rho_se", number_json(fit.is_known() ? std::optional(fit.rho_se) : std::nullopt)},
              {"rms", fit.rms},
              {"used", fit.used.size()},
              {"rejected", std::move(rejected)}};
    if (!fit.p_determined())
        json["p_status"] = fit.p.status;
    if (!fit.q_determined())
        json["q_status"] = fit.q.status;
    if (!fit.has_sizes())
        json["misfit"] = fit.misfit;
    return json;
}

} // namespace tvbeam
