#include "reports/formats/html_report.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

struct HtmlFormat final : ReportFormat {
    std::string name() const override { return "html"; }
    bool shows_plots() const override { return true; }
    std::vector<std::string> certain_files() const override { return {"report.html"}; }

    std::vector<NamedText> write(const ReportContents& contents) const override {
        const auto& [result, plots, drawn] = contents;
        HtmlContents page{
            .document = result.document,
            .failed = result.failed,
            .interrupted = result.interrupted,
            .formulas = result.formulas ? result.formulas() : std::vector<Formula>(),
            .figures = {},
            .no_figures = drawn.failure.empty() ? "" : drawn.failure + ": pictures are left out",
            .scene_text = result.source_text};
        for (std::size_t i = 0; i < plots.size(); ++i)
            page.figures.push_back({plots[i].name, plots[i].caption, drawn.plots[i].svg});
        return {{"report.html", html_report(page)}};
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, HtmlFormat>();

} // namespace tvbeam
