#include "reports/formats/csv_report.hpp"

#include "reports/formats/report_format.hpp"
#include "studies/table_row.hpp"
namespace tvbeam {

std::vector<StudyCsv> study_csvs(const StudyResult& result) {
    std::vector<StudyCsv> all;
    for (const auto* report : reports_of(result))
        for (auto& csv : report->csvs(result))
            all.push_back(std::move(csv));
    return all;
}

bool is_study_csv(const std::string& name, const std::string& first_line) {
    for (const auto& report : study_reports())
        for (const auto& [csv, head] : report->csv_heads())
            if (name == csv + ".csv" && first_line.starts_with(head))
                return true;
    return false;
}

LongText csv_report(const StudyResult& result) {
    const auto all = study_csvs(result);
    return all.empty() ? LongText("") : all.front().text; // none of an interrupted study
}

struct CsvFormat final : ReportFormat {
    std::string name() const override { return "csv"; }
    std::vector<NamedText> write(const ReportContents& contents) const override {
        return contents.reported.csvs();
    }
    std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& directory) const override {
        std::vector<std::filesystem::path> files;
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(directory, ignored))
            if (is_study_csv(entry.path().filename(), first_line(entry.path())))
                files.push_back(entry.path().filename());
        return files;
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, CsvFormat>();

} // namespace tvbeam
