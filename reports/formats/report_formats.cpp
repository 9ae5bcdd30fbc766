#include "reports/formats/report_format.hpp"

#include <fstream>

namespace tvbeam {

/// In the order in which files are written.
constexpr RowMaker<ReportFormat> formats[] = {
    make_row<ReportFormat, struct JsonFormat>,     make_row<ReportFormat, struct CsvFormat>,
    make_row<ReportFormat, struct MarkdownFormat>, make_row<ReportFormat, struct LatexFormat>,
    make_row<ReportFormat, struct PlotsFormat>,    make_row<ReportFormat, struct HtmlFormat>,
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

std::string first_line(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

} // namespace tvbeam
