#include "reports/studies/run_fields.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/table_row.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tvbeam {

using Json = nlohmann::ordered_json;

namespace {

std::string adds_text(const GivenData& defect) {
    std::string text;
    for (const auto& [name, source] : named_parts(defect))
        text += fmt::format("{}{} + ({})", text.empty() ? "" : ", ", name, source);
    return text;
}

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const auto& name : names)
        list += (list.empty() ? "" : "; ") + name;
    return list;
}

/// What catches a defect first, and how many never do.
std::string finding(const CaughtDefect& defect, const SensitivityResult& result,
                    const SensitivityBlock& block) {
    const auto least = defect.least_of_all();
    if (!least)
        return defect.least.empty()
                   ? fmt::format("{}: no expectation that it could change holds without it, so "
                                 "that none was "
                                 "asked.",
                                 defect.name)
                   : fmt::format("{}: no expectation catches it at the factors tried, one a decade "
                                 "up to {}.",
                                 defect.name, shortest(block.largest));
    const auto unseen = std::count(defect.least.begin(), defect.least.end(), std::nullopt);
    // At the least factor that is tried nobody knows which of several is the first.
    std::vector<std::string> first;
    for (std::size_t i = 0; i < defect.least.size(); ++i)
        if (defect.least[i] == least)
            first.push_back(result.expectations[i]);
    return fmt::format(
        "{}: first caught at {} {}times its size, by {}; {} of {} expectations catch "
        "it at no factor tried.",
        defect.name, scientific(*least, 1), *least <= block.smallest ? "or fewer " : "",
        listed(first), unseen, defect.least.size());
}

Section section(const SensitivityResult& result, const SensitivityBlock& block) {
    Table table{
        "The factor at which an expectation of the scene first catches a defect: of one a "
        "decade, and, by bisection to 5 % above it, of those from the last that it lets pass to "
        "the first "
        "that it catches. What it catches between two decades alone is not found. Empty: at "
        "none that was tried.",
        {"", {{"expectation", result.expectations}}},
        {{"", {}}}};
    Section section{"Sensitivity of the expectations", {}};
    auto& blocks = section.blocks;
    blocks.emplace_back(
        Paragraph{fmt::format("Sensitivity: defects times {} to {}, and the factor at which each "
                              "expectation first catches them",
                              shortest(block.smallest), shortest(block.largest))});
    for (std::size_t k = 0; k < result.defects.size(); ++k) {
        const auto& defect = result.defects[k];
        Table::Column column{defect.name, {}};
        for (const auto& least : defect.least)
            column.cells.push_back(!least                     ? ""
                                   : *least <= block.smallest ? "<= " + scientific(least, 1)
                                                              : scientific(least, 1));
        table.groups.front().columns.push_back(std::move(column));
        blocks.emplace_back(Item{defect.name + ": " + adds_text(block.defects[k].adds)});
    }
    if (!result.expectations.empty() && !result.defects.empty()) {
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(std::move(table));
        blocks.emplace_back(BlankLine{});
    }
    for (const auto& defect : result.defects)
        blocks.emplace_back(Finding{finding(defect, result, block)});
    if (!result.violated.empty())
        blocks.emplace_back(Finding{"Violated without any of these defects, and left out: " +
                                    listed(result.violated) + "."});
    return section;
}

Json json_of(const SensitivityResult& result, const SensitivityBlock& block) {
    Json defects = Json::array();
    for (std::size_t k = 0; k < result.defects.size(); ++k) {
        Json least = Json::object();
        for (std::size_t i = 0; i < result.expectations.size(); ++i)
            least[result.expectations[i]] = number_json(result.defects[k].least[i]);
        Json adds = Json::object();
        for (const auto& [name, source] : named_parts(block.defects[k].adds))
            adds[name] = source;
        defects.push_back({{"name", result.defects[k].name},
                           {"adds", std::move(adds)},
                           {"least", number_json(result.defects[k].least_of_all())},
                           {"expectations", std::move(least)}});
    }
    return {{"range", {block.smallest, block.largest}},
            {"violated", result.violated},
            {"defects", std::move(defects)}};
}

} // namespace

struct SensitivityReport final : StudyReport {
    std::string study() const override { return "sensitivity"; }
    std::vector<Section> sections(const StudyResult& result) const override {
        return {section(*result.get<SensitivityResult>(), *result.scene.get<SensitivityBlock>())};
    }
    Json json(const StudyResult& result) const override {
        return json_of(*result.get<SensitivityResult>(), *result.scene.get<SensitivityBlock>());
    }
    std::vector<StudyCsv> csvs(const StudyResult& result) const override {
        const auto& record = *result.get<SensitivityResult>();
        std::string text = "defect,expectation,least\n";
        for (const auto& defect : record.defects)
            for (std::size_t i = 0; i < defect.least.size(); ++i)
                text += quoted(defect.name) + "," + quoted(record.expectations[i]) +
                        number_field(defect.least[i]) + "\n";
        return {{study(), text}};
    }
    std::vector<std::pair<std::string, std::string>> csv_heads() const override {
        return {{study(), "defect,expectation,least"}};
    }
};

template std::unique_ptr<const StudyReport> make_row<StudyReport, SensitivityReport>();

} // namespace tvbeam
