#include "reports/formats/report_format.hpp"

#include "reports/document/problem_formulas.hpp"
#include "reports/document/result_document.hpp"
#include "reports/formats/csv_report.hpp"
#include "reports/formats/json_report.hpp"

#include <fstream>

namespace tvbeam {

/// In the order in which files are written.
constexpr RowMaker<ReportFormat> formats[] = {
    make_row<ReportFormat, struct JsonFormat>,     make_row<ReportFormat, struct CsvFormat>,
    make_row<ReportFormat, struct MarkdownFormat>, make_row<ReportFormat, struct LatexFormat>,
    make_row<ReportFormat, struct PlotsFormat>,    make_row<ReportFormat, struct PdfFormat>,
    make_row<ReportFormat, struct PgfplotsFormat>, make_row<ReportFormat, struct HtmlFormat>,
};

const RowsOf<ReportFormat>& report_formats() {
    static const auto all = made_of(formats);
    return all;
}

std::vector<std::string> report_format_names() {
    std::vector<std::string> names;
    for (const auto& format : report_formats())
        names.push_back(format->name());
    return names;
}

Reported reported(const StudyResult& result) {
    Reported all{.document = result_document(result),
                 .json = [&result] { return json_report(result); },
                 .csvs =
                     [&result] {
                         std::vector<NamedText> texts;
                         for (auto& csv : study_csvs(result))
                             texts.push_back({csv.name + ".csv", std::move(csv.text)});
                         return texts;
                     },
                 .plots = [&result] { return plots_of(result); },
                 .failed = result.failed(),
                 .interrupted = result.interrupted(),
                 .source_text = result.scene.text};
    // A stress study has problems of its own.
    if (result.scene.poses_problem() && !result.scene.solver)
        all.formulas = [&result] { return problem_formulas(result.scene); };
    return all;
}

std::string first_line(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

std::vector<std::string>
earlier_figures(const std::filesystem::path& directory, const std::string& ending,
                const std::function<std::string(const std::string& name)>& beginning) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(directory / "plots", ignored)) {
        const std::string name = entry.path().stem();
        if (entry.path().extension() == ending &&
            first_line(entry.path()).starts_with(beginning(name)))
            names.push_back(name);
    }
    return names;
}

std::vector<std::string> earlier_drawn_figures(const std::filesystem::path& directory) {
    return earlier_figures(directory, ".gp",
                           [](const std::string& name) { return "# Draws " + name + ".svg"; });
}

} // namespace tvbeam
