#include "reports/document/orders_section.hpp"
#include "reports/studies/fit_fields.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/grid/grid.hpp"
#include "studies/table_row.hpp"

#include <nlohmann/json.hpp>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

Json interval_json(const OrderInterval& of) {
    const auto known = [&](double number) {
        return number_json(of.determined ? std::optional(number) : std::nullopt);
    };
    Json json{{"value", known(of.value)}, {"low", known(of.low)}, {"high", known(of.high)}};
    if (!of.determined)
        json["status"] = of.status;
    return json;
}

Json limit_json(const GridLimit& of) {
    Json json{{"limit", interval_json(of.limit)},
              {"p", interval_json(of.p)},
              {"q", interval_json(of.q)},
              {"uncertainty", number_json(of.uncertainty)}};
    if (json["uncertainty"].is_null())
        json["status"] = of.limit.status;
    for (const auto& rung : of.out_of_line)
        json["out_of_line"].push_back({{"elements", rung.elements}, {"dt", rung.dt}});
    return json;
}

Json json_of(const OrdersResult& orders, const OrdersBlock& block) {
    Json norms = Json::object();
    for (const auto& [norm, fit, rounding] : orders.norms)
        norms[norm] = fit_json(fit, [&](std::size_t record) -> Json {
            const Rung& rung = orders.runs[record].rung;
            return {{"elements", rung.elements}, {"dt", rung.dt}};
        });
    Json runs = Json::array();
    for (const auto& run : orders.runs) {
        Json entry = run_json(run);
        add_errors(entry, run, block.norms);
        runs.push_back(std::move(entry));
    }
    Json json{{"final_time", block.final_time > 0.0 ? Json(block.final_time) : Json()},
              {"norms", std::move(norms)},
              {"runs", std::move(runs)}};
    for (const auto& of : orders.values)
        json["values"][of.value] = limit_json(of);
    if (!orders.reference_remark.empty())
        json["remarks"] = {orders.reference_remark};
    if (orders.refined)
        add_ending(json, *orders.refined);
    if (orders.corollary)
        json["corollary_constant"] = {{"least", orders.corollary->least},
                                      {"greatest", orders.corollary->greatest},
                                      {"finest", orders.corollary->finest}};
    return json;
}

std::string grid_csv(const OrdersResult& orders, const std::vector<Measure>& norms) {
    std::string text = "elements,h,dt,steps,status";
    for (const auto& norm : norms)
        text += "," + norm.name;
    text += ",seconds,reason\n";
    for (const auto& run : orders.runs) {
        text += run_fields(run);
        for (std::size_t k = 0; k < norms.size(); ++k)
            text += measure_field(run, k);
        text += cost_fields(run);
    }
    return text;
}

} // namespace

struct OrdersReport final : StudyReport {
    std::string study() const override { return "orders"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return {orders_section(*result.get<OrdersResult>(), *result.scene.get<OrdersBlock>())};
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<OrdersResult>(), *result.scene.get<OrdersBlock>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        return {{study(),
                 grid_csv(*result.get<OrdersResult>(), result.scene.get<OrdersBlock>()->norms)}};
    }
    std::vector<Plot> plots(const StudyResult& result) const override {
        return error_surface_plots(result);
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), run_columns}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, OrdersReport>();

} // namespace tvbeam
