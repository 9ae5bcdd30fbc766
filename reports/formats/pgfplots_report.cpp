#include "reports/formats/report_format.hpp"
#include "reports/plots/pgfplots_text.hpp"
#include "studies/table_row.hpp"

#include <algorithm>
#include <iterator>

namespace tvbeam {

/// The figures as LaTeX draws them, in the letters and the width of a paper.
struct PgfplotsFormat final : ReportFormat {
    std::string name() const override { return "pgfplots"; }
    bool is_written_unasked() const override { return false; }
    bool describes_plots() const override { return true; }
    std::vector<std::string> certain_files() const override { return {"plots/convergence.tex"}; }

    std::vector<NamedText> write(const ReportContents& contents) const override {
        std::vector<NamedText> texts;
        for (const auto& plot : contents.plots)
            texts.push_back({"plots/" + plot.name + ".tex", pgfplots_text(plot)});
        return texts;
    }

    std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& directory) const override {
        std::vector<std::filesystem::path> files;
        const auto drawn = earlier_figures(directory, ".tex", [](const std::string& name) {
            return "% " + name + ".tex draws a figure";
        });
        std::transform(drawn.begin(), drawn.end(), std::back_inserter(files),
                       [](const std::string& name) { return "plots/" + name + ".tex"; });
        return files;
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, PgfplotsFormat>();

} // namespace tvbeam
