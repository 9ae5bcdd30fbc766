#include "reports/formats/json_report.hpp"

#include "reports/document/json_text.hpp"
#include "reports/document/result_document.hpp"
#include "reports/files/provenance.hpp"
#include "reports/formats/report_format.hpp"
#include "reports/studies/study_report.hpp"
#include "reports/sweep/sweep.hpp"
#include "studies/table_row.hpp"

#include <nlohmann/json.hpp>

namespace tvbeam {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ReferenceResult& reference, const ReferenceBlock& block) {
    Json json{{"elements", block.elements},
              {"dt", block.dt},
              {"richardson", block.richardson},
              {"status", reference.failure.empty() ? "ok" : "failed"},
              {"seconds", reference.seconds}};
    if (!reference.failure.empty())
        json["reason"] = reference.failure;
    json["runs"] = Json::array();
    for (const auto& run : reference.runs)
        json["runs"].push_back({{"elements", run.elements}, {"dt", run.dt}, {"steps", run.steps}});
    json["levels"] = reference.times.size();
    return json;
}

} // namespace

nlohmann::ordered_json provenance_json(const Scene& scene) {
    const Provenance p = provenance_of(scene);
    return {{"version", p.version},    {"commit", p.commit},
            {"compiler", p.compiler},  {"build_type", p.build_type},
            {"flags", p.flags},        {"processor", p.processor},
            {"date", p.date},          {"scene_file", p.scene_file},
            {"overrides", p.overrides}};
}

nlohmann::ordered_json result_json(const StudyResult& result) {
    Json json = Json::object();
    if (result.scene.defect)
        json["defect"] = defect_words;
    json.update({{"schema", "tvbeam-result/1"},
                 {"scene", Json::parse(result.scene.json())},
                 {"provenance", provenance_json(result.scene)},
                 {"left_out", result.left_out},
                 {"remarks", result.remarks},
                 {"interrupted", result.interrupted()}});
    if (result.law_distance > 0.0)
        json["law_distance"] = result.law_distance;
    if (result.quadrature && result.quadrature->intervals > 1)
        json["quadrature"] = {{"intervals", result.quadrature->intervals},
                              {"finest", result.quadrature->finest}};
    if (result.separation.rank > 0)
        json["separation"] = {{"rank", result.separation.rank},
                              {"residual", result.separation.residual}};
    else if (!result.separation.reason.empty())
        json["separation"] = {{"rank", nullptr}, {"status", result.separation.reason}};
    if (result.reference)
        json["reference"] = json_of(*result.reference, *result.scene.reference);
    for (const auto* report : reports_of(result))
        json[report->study()] = report->json(result);
    return json;
}

std::string json_report(const StudyResult& result) {
    return json_text(result_json(result));
}

struct JsonFormat final : ReportFormat {
    std::string name() const override { return "json"; }
    std::vector<std::string> certain_files() const override { return {"result.json"}; }
    std::vector<NamedText> write(const ReportContents& contents) const override {
        return {{"result.json", contents.reported.json()}};
    }
    std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& directory) const override {
        return files_of_sweep(directory);
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, JsonFormat>();

} // namespace tvbeam
