#include "reports/files/report_directory.hpp"

#include "reports/document/problem_formulas.hpp"
#include "reports/document/result_document.hpp"
#include "reports/formats/csv_report.hpp"
#include "reports/formats/html_report.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/formats/latex_report.hpp"
#include "reports/formats/markdown_report.hpp"
#include "reports/plots/gnuplot.hpp"
#include "reports/plots/plot.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <list>
#include <system_error>
#include <utility>

namespace tvbeam {

namespace {

const char* const json_name = "result.json";
const char* const markdown_name = "table.md";
const char* const html_name = "report.html";
const char* const latex_name = "table.tex";
const std::filesystem::path plots_name = "plots";

/// The files whose names do not depend on the result.
std::vector<std::string> fixed_names(const ReportBlock& block) {
    std::vector<std::string> names;
    for (const auto& [file, name] : {std::pair{ReportFile::json, json_name},
                                     {ReportFile::markdown, markdown_name},
                                     {ReportFile::latex, latex_name},
                                     {ReportFile::html, html_name}})
        if (block.wants(file))
            names.emplace_back(name);
    return names;
}

struct NamedText {
    std::string name; ///< within the directory
    std::string text;
};

void add_plots(std::vector<NamedText>& texts, const std::vector<Plot>& plots,
               const DrawnPlots& drawn) {
    for (std::size_t i = 0; i < plots.size(); ++i) {
        const std::string name = plots_name / plots[i].name;
        texts.push_back({name + ".gp", plots[i].script});
        texts.push_back({name + ".dat", plots[i].data});
        if (!drawn.plots[i].svg.empty()) {
            texts.push_back({name + ".svg", drawn.plots[i].svg});
            texts.push_back({name + ".png", drawn.plots[i].png});
        }
    }
}

std::string without_pictures(const DrawnPlots& drawn) {
    return drawn.failure.empty() ? "" : drawn.failure + ": pictures are left out";
}

HtmlContents html_contents(const StudyResult& result, const Document& document,
                           const std::vector<Plot>& plots, const DrawnPlots& drawn) {
    HtmlContents contents{.document = document,
                          .failed = result.failed(),
                          .interrupted = result.interrupted(),
                          .formulas = {},
                          .figures = {},
                          .no_figures = without_pictures(drawn),
                          .scene_text = result.scene.text};
    // A stress study has problems of its own.
    if (result.scene.poses_problem())
        contents.formulas = problem_formulas(result.scene);
    for (std::size_t i = 0; i < plots.size(); ++i)
        contents.figures.push_back({plots[i].name, plots[i].caption, drawn.plots[i].svg});
    return contents;
}

} // namespace

ReportDirectory::ReportDirectory(std::filesystem::path path, const ReportBlock& block)
    : path_(std::move(path)), block_(block) {
    make(path_);
    lock();
    for (const auto& name : fixed_names(block_))
        OutputFile{path_ / name};
    if (block_.wants(ReportFile::plots)) {
        make(path_ / plots_name);
        OutputFile{path_ / plots_name / "convergence.svg"};
    }
}

ReportDirectory::~ReportDirectory() {
    if (lock_ >= 0)
        close(lock_);
    std::error_code ignored;
    for (const auto& directory : made_)
        if (std::filesystem::is_empty(directory, ignored) && !ignored)
            std::filesystem::remove(directory, ignored);
}

void ReportDirectory::make(const std::filesystem::path& directory) {
    std::error_code error;
    if (std::filesystem::is_directory(directory, error))
        return;
    if (std::filesystem::exists(directory, error))
        throw OutputError("cannot write to '" + directory.string() +
                          "': it is not a directory; name one, or one that is to be made");
    if (directory.has_parent_path())
        make(directory.parent_path());
    if (!std::filesystem::create_directory(directory, error) && error)
        throw OutputError("cannot make the directory '" + directory.string() +
                          "': " + error.message());
    made_.insert(made_.begin(), directory);
}

/// Plots and tables that an earlier result has left would be taken for a part of this one. They are
/// known by their first lines; files of another origin stay.
void ReportDirectory::remove_earlier(const std::set<std::string>& written) const {
    std::vector<std::filesystem::path> earlier;
    std::error_code ignored;
    const auto first_line = [](const std::filesystem::path& file) {
        std::ifstream stream(file);
        std::string line;
        std::getline(stream, line);
        return line;
    };
    if (block_.wants(ReportFile::csv))
        for (const auto& entry : std::filesystem::directory_iterator(path_, ignored))
            if (is_study_csv(entry.path().filename(), first_line(entry.path())))
                earlier.push_back(entry.path().filename());
    if (block_.wants(ReportFile::plots))
        for (const auto& entry : std::filesystem::directory_iterator(path_ / plots_name, ignored)) {
            const std::string stem = entry.path().stem();
            if (entry.path().extension() == ".gp" &&
                first_line(entry.path()).starts_with("# Draws " + stem + ".svg"))
                for (const char* ending : {".gp", ".dat", ".svg", ".png"})
                    earlier.push_back(plots_name / (stem + ending));
        }
    for (const auto& file : earlier)
        if (!written.contains(file))
            std::filesystem::remove(path_ / file, ignored);
}

void ReportDirectory::lock() {
    lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const std::string reason = std::generic_category().message(errno);
        const bool taken = lock_ >= 0 && errno == EWOULDBLOCK;
        throw OutputError("cannot write to '" + path_.string() + "': " +
                          (taken ? "another tvbeam is writing there; wait for it, or name another "
                                   "directory"
                                 : reason));
    }
}

std::string ReportDirectory::write(const StudyResult& result) {
    std::vector<NamedText> texts;
    if (block_.wants(ReportFile::json))
        texts.push_back({json_name, json_report(result)});
    if (block_.wants(ReportFile::csv))
        for (auto& study : study_csvs(result))
            texts.push_back({study.study + ".csv", std::move(study.text)});
    const Document document = result_document(result);
    if (block_.wants(ReportFile::markdown))
        texts.push_back({markdown_name, markdown_report(document)});
    if (block_.wants(ReportFile::latex))
        texts.push_back({latex_name, latex_report(document)});
    DrawnPlots drawn;
    const auto plots = (block_.wants(ReportFile::plots) || block_.wants(ReportFile::html))
                           ? plots_of(result)
                           : std::vector<Plot>();
    if (!plots.empty())
        drawn = draw(plots);
    if (block_.wants(ReportFile::plots))
        add_plots(texts, plots, drawn);
    if (block_.wants(ReportFile::html))
        texts.push_back({html_name, html_report(html_contents(result, document, plots, drawn))});
    std::list<OutputFile> files;
    std::set<std::string> written;
    for (const auto& [name, text] : texts) {
        files.emplace_back(path_ / name).prepare(text);
        written.insert(name);
    }
    for (auto& file : files)
        file.publish();
    remove_earlier(written);
    return drawn.failure.empty() ? ""
                                 : drawn.failure +
                                       "; the pictures are left out, their scripts "
                                       "and data are in '" +
                                       (path_ / plots_name).string() + "'";
}

} // namespace tvbeam
