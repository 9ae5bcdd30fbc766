#pragma once

#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// The block [report]: what `tvbeam run --out` writes.
struct ReportBlock {
    std::vector<std::string> files; ///< kinds of files by name; empty: what is written unasked

    [[nodiscard]] bool names(const std::string& file) const;
};

/// Reads the block:
///
///     files    e.g. ["json", "html"], at least one, none twice; absent: all but pgfplots
///
/// known: the kinds there are; empty: whatever it names is taken. Throws InputError.
ReportBlock read_report(TableReader table, const std::vector<std::string>& known);

} // namespace tvbeam
