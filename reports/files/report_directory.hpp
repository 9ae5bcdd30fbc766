#pragma once

#include "reports/files/output_file.hpp"
#include "studies/study.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tvbeam {

class ReportFormat;
struct Reported;

/// The directory that `--out` names, and in it the files that a scene's [report] block asks for:
///
///     json        result.json
///     csv         a file for each study: ladder.csv, orders.csv, …
///     markdown    table.md
///     latex       table.tex
///     plots       plots/NAME.gp, .dat, .svg, .png for each figure; without gnuplot the first two
///     pdf         plots/NAME.pdf
///     pgfplots    plots/NAME.tex; only where it is asked for by name
///     html        report.html
///
/// Each appears whole or not at all, and none of them before all could be brought to the disk;
/// where one cannot be given its name, none is, on file systems that can exchange two files. A
/// file of an earlier result is replaced, and its plots and CSV files, and the directories of the
/// values of a sweep, go where this result has none of their names. Kinds of files that a block
/// leaves out stay as they are; figures for LaTeX go unless they are asked for again, and PDFs
/// where plots are written without them, as a paper would go on to show what they were.
class ReportDirectory {
public:
    /// Makes the directory where it is missing, and keeps others from writing there as long as the
    /// object exists. Throws OutputError when that fails or when nothing can be written there.
    ReportDirectory(std::filesystem::path path, const ReportBlock& block);
    /// Takes away the directories that were made, if nothing was written to them.
    ~ReportDirectory();
    ReportDirectory(const ReportDirectory&) = delete;
    ReportDirectory& operator=(const ReportDirectory&) = delete;
    ReportDirectory(ReportDirectory&&) = delete;
    ReportDirectory& operator=(ReportDirectory&&) = delete;

    /// Returns a sentence on plots that could not be drawn, or nothing. Throws OutputError when
    /// something cannot be written; then nothing is.
    std::string write(const Reported& result);

private:
    void make(const std::filesystem::path& directory);
    void lock();
    [[nodiscard]] std::vector<std::filesystem::path> earlier_files() const;

    std::filesystem::path path_;
    std::vector<const ReportFormat*> formats_; ///< those that are wanted
    int lock_ = -1;                            ///< a descriptor of the directory
    std::vector<std::filesystem::path> made_;  ///< inner ones first
};

} // namespace tvbeam
