#include "reports/formats/report_format.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

/// The pictures as pages for a paper, whose letters and lines stay such.
struct PdfFormat final : ReportFormat {
    std::string name() const override { return "pdf"; }
    bool shows_plots() const override { return true; }
    std::vector<std::string> certain_files() const override { return {"plots/convergence.pdf"}; }

    std::vector<NamedText> write(const ReportContents& contents) const override {
        std::vector<NamedText> texts;
        for (std::size_t i = 0; i < contents.plots.size(); ++i)
            if (const auto& pdf = contents.drawn.plots[i].pdf; !pdf.empty())
                texts.push_back({"plots/" + contents.plots[i].name + ".pdf", pdf});
        return texts;
    }

    /// Beside the scripts that drew them.
    std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& directory) const override {
        std::vector<std::filesystem::path> files;
        for (const auto& name : earlier_drawn_figures(directory))
            files.emplace_back("plots/" + name + ".pdf");
        return files;
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, PdfFormat>();

} // namespace tvbeam
