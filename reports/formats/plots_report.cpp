#include "reports/formats/report_format.hpp"
#include "reports/plots/gnuplot_script.hpp"
#include "studies/table_row.hpp"

namespace tvbeam {

struct PlotsFormat final : ReportFormat {
    std::string name() const override { return "plots"; }
    bool shows_plots() const override { return true; }
    std::vector<std::string> certain_files() const override { return {"plots/convergence.svg"}; }

    /// Without gnuplot, scripts and data only.
    std::vector<NamedText> write(const ReportContents& contents) const override {
        std::vector<NamedText> texts;
        for (std::size_t i = 0; i < contents.plots.size(); ++i) {
            const Plot& plot = contents.plots[i];
            const std::string file = "plots/" + plot.name;
            texts.push_back({file + ".gp", gnuplot_script(plot.drawing, plot.name)});
            texts.push_back({file + ".dat", gnuplot_data(plot.drawing)});
            if (const DrawnPlot& drawn = contents.drawn.plots[i]; !drawn.svg.empty()) {
                texts.push_back({file + ".svg", drawn.svg});
                texts.push_back({file + ".png", drawn.png});
            }
        }
        return texts;
    }

    std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& directory) const override {
        std::vector<std::filesystem::path> files;
        for (const auto& name : earlier_drawn_figures(directory))
            for (const char* ending : {".gp", ".dat", ".svg", ".png", ".pdf"})
                files.emplace_back("plots/" + name + ending);
        return files;
    }
};

template std::unique_ptr<const ReportFormat> make_row<ReportFormat, PlotsFormat>();

} // namespace tvbeam
