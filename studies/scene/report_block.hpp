#pragma once

#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// A kind of file that a result can be written to.
enum class ReportFile { json, csv, markdown, latex, plots, html };

/// The block [report]: what `tvbeam run --out` writes. Without it, every kind.
struct ReportBlock {
    std::vector<ReportFile> files{ReportFile::json,  ReportFile::csv,   ReportFile::markdown,
                                  ReportFile::latex, ReportFile::plots, ReportFile::html};

    [[nodiscard]] bool wants(ReportFile file) const;
};

/// Reads the block:
///
///     files    of "json", "csv", "markdown", "latex", "plots", "html", at least one, none twice;
///              absent: all of them
///
/// Throws InputError.
ReportBlock read_report(TableReader table);

} // namespace tvbeam
