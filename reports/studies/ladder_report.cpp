#include "reports/analysis/analysis_reports.hpp"
#include "reports/document/ladder_section.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/table_row.hpp"

#include <nlohmann/json.hpp>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

Json json_of(const LadderResult& ladder, const LadderBlock& block) {
    Json rungs = Json::array();
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        Json entry = run_json(ladder.rungs[i]);
        add_errors(entry, ladder.rungs[i], block.norms);
        Json orders = Json::object();
        Json printed = Json::object();
        Json predicted = Json::object();
        Json interval = Json::object();
        Json verdict = Json::object();
        Json reason = Json::object();
        for (const auto& norm : ladder.norms) {
            const std::string& name = norm.norm.name;
            if (block.printed && block.printed->figures.contains(name))
                printed[name] = block.printed->figures.at(name)[i];
            if (norm.norm.is_value)
                continue;
            orders[name] = number_json(norm.orders[i]);
            if (!norm.predictions.empty()) {
                const auto& prediction = norm.predictions[i];
                predicted[name] = number_json(prediction.value);
                interval[name] = {number_json(prediction.low), number_json(prediction.high)};
            }
            verdict[name] = name_of(norm.verdicts[i].verdict);
            reason[name] = norm.verdicts[i].reason;
        }
        entry["orders"] = std::move(orders);
        if (!printed.empty())
            entry["printed"] = std::move(printed);
        if (!predicted.empty())
            entry["predicted"] = std::move(predicted);
        if (!interval.empty())
            entry["predicted_interval"] = std::move(interval);
        entry["verdict"] = std::move(verdict);
        entry["verdict_reason"] = std::move(reason);
        entry["counters"] = counters_json(ladder.rungs[i]);
        rungs.push_back(std::move(entry));
    }
    Json json{{"final_time", block.final_time > 0.0 ? Json(block.final_time) : Json()},
              {"rungs", std::move(rungs)}};
    if (ladder.refined)
        add_ending(json, *ladder.refined);
    if (ladder.analysis)
        for (std::size_t k = 0; k < block.norms.size(); ++k)
            add_analysis(json["analysis"][block.norms[k].root()], *ladder.analysis,
                         ladder.analysis->columns[k]);
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

std::string ladder_csv(const LadderResult& ladder, const std::optional<PublishedFigures>& printed) {
    const auto has_figures = [&](const std::string& norm) {
        return printed && printed->figures.contains(norm);
    };
    std::string text = "elements,h,dt,steps,status";
    for (const auto& norm : ladder.norms) {
        const std::string& name = norm.norm.name;
        text += "," + name;
        if (has_figures(name))
            text += "," + name + "_printed";
        if (!norm.norm.is_value)
            text += "," + name + "_order";
        if (!norm.predictions.empty())
            for (const char* figure : {"_predicted", "_predicted_low", "_predicted_high"})
                text += "," + name + figure;
    }
    text += ",seconds,reason\n";
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
        text += run_fields(ladder.rungs[i]);
        for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
            const LadderNorm& norm = ladder.norms[k];
            text += measure_field(ladder.rungs[i], k);
            if (has_figures(norm.norm.name))
                text += number_field(printed->figures.at(norm.norm.name)[i]);
            if (!norm.norm.is_value)
                text += number_field(norm.orders[i]);
            if (!norm.predictions.empty())
                for (const double figure :
                     {norm.predictions[i].value, norm.predictions[i].low, norm.predictions[i].high})
                    text += finite_field(figure);
        }
        text += cost_fields(ladder.rungs[i]);
    }
    return text;
}

} // namespace

struct LadderReport final : StudyReport {
    std::string study() const override { return "ladder"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return {ladder_section(*result.get<LadderResult>(), *result.scene.get<LadderBlock>(),
                               result.scene.method())};
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<LadderResult>(), *result.scene.get<LadderBlock>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        return {{study(), ladder_csv(*result.get<LadderResult>(),
                                     result.scene.get<LadderBlock>()->printed)}};
    }
    std::vector<Plot> plots(const StudyResult& result) const override {
        auto plots = convergence_plots(result);
        if (const auto& analysis = result.get<LadderResult>()->analysis)
            for (auto& plot : value_plots(*analysis))
                plots.push_back(std::move(plot));
        return plots;
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), run_columns}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, LadderReport>();

} // namespace tvbeam
