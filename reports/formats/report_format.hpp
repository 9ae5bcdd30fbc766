#pragma once

#include "reports/document/document.hpp"
#include "reports/files/long_text.hpp"
#include "reports/formats/html_report.hpp"
#include "reports/plots/gnuplot.hpp"
#include "reports/plots/plot.hpp"
#include "studies/study.hpp"
#include "studies/table_rows.hpp"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace tvbeam {

struct NamedText {
    std::string name; ///< of a file within the directory
    LongText text;
};

/// What is reported: the result of a scene, or the analysis of a table. Formats call for what they
/// write.
struct Reported {
    Document document = {};
    std::function<std::string()> json = {};
    std::function<std::vector<NamedText>()> csvs = {};
    std::function<std::vector<Plot>()> plots = {};
    bool failed = false;                                 ///< a run did
    bool interrupted = false;                            ///< runs are missing
    std::function<std::vector<Formula>()> formulas = {}; ///< of the problem
    std::string source_text = {};                        ///< of the scene
    std::set<std::string> directories = {}; ///< beside its files, with results of its parts
};

/// The result of a scene.
Reported reported(const StudyResult& result);

/// What formats are written from.
struct ReportContents {
    const Reported& reported;
    const std::vector<Plot>& plots; ///< none where no format that is wanted has them
    const DrawnPlots& drawn;
};

/// A kind of file that a result can be written to.
class ReportFormat {
public:
    virtual ~ReportFormat() = default;

    [[nodiscard]] virtual std::string name() const = 0; ///< by which [report] asks for it
    /// Where [report] names no kinds of files.
    [[nodiscard]] virtual bool is_written_unasked() const { return true; }
    [[nodiscard]] virtual bool describes_plots() const { return shows_plots(); }
    [[nodiscard]] virtual bool shows_plots() const { return false; } ///< as gnuplot draws them

    /// Files that it writes whatever the result, one at least in every directory it writes to; none
    /// if their names depend on the result.
    [[nodiscard]] virtual std::vector<std::string> certain_files() const { return {}; }
    [[nodiscard]] virtual std::vector<NamedText> write(const ReportContents& contents) const = 0;

    /// Files in a directory that an earlier result has left and that would be taken for a part of
    /// this one: known by their first lines, or what they say of each other, so that files of
    /// another origin stay. Directories behind what is in them.
    [[nodiscard]] virtual std::vector<std::filesystem::path>
    earlier_files(const std::filesystem::path& /*directory*/) const {
        return {};
    }
};

/// Every format, in the order in which files are written.
const RowsOf<ReportFormat>& report_formats();

/// Their names.
std::vector<std::string> report_format_names();

/// The first line of a file; empty where it cannot be read.
std::string first_line(const std::filesystem::path& file);

/// The figures that an earlier result has left in a directory, by the names of their files without
/// ending: of those with this ending, which begin as `beginning` says of the name.
std::vector<std::string>
earlier_figures(const std::filesystem::path& directory, const std::string& ending,
                const std::function<std::string(const std::string& name)>& beginning);

/// Of those that gnuplot draws, by their scripts.
std::vector<std::string> earlier_drawn_figures(const std::filesystem::path& directory);

} // namespace tvbeam
