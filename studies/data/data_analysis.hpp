/// What a table of errors and values shows (data_file.hpp): orders with 95 % intervals, limits,
/// verdicts, and a sentence for each column.
#pragma once

#include "studies/data/data_file.hpp"
#include "studies/data/record_analysis.hpp"
#include "studies/orders/limit_engine.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

struct ColumnAnalysis {
    std::string name;
    bool is_value = false;       ///< of a number without known limit; else an error
    std::vector<double> numbers; ///< one a row
    std::vector<bool> missing;   ///< DataColumn::missing
    /// One a row; empty where several widths are refined independently, and for values.
    std::vector<std::optional<double>> orders;
    std::vector<RowVerdict> verdicts;    ///< one a row; empty with three widths, and for values
    std::vector<OrderInterval> by_width; ///< one a width
    std::optional<TwoTermFit> two_term;  ///< of errors on a grid of two widths
    std::pair<std::size_t, std::size_t> of_model = {}; ///< the widths that are its h and dt
    std::optional<LimitEstimate> limit;                ///< of values
    std::vector<std::string> findings;                 ///< in words
};

struct DataAnalysis {
    std::string name;               ///< of the file
    std::vector<DataColumn> widths; ///< from coarse to fine by the first, then by the others
    std::vector<ColumnAnalysis> columns;
    std::vector<std::string> remarks;
    std::vector<std::string> chosen = {}; ///< DataFile::chosen

    std::size_t rows() const { return widths.front().numbers.size(); }
};

DataAnalysis analyse(const DataFile& data);

/// Whether the number of a row is none that a run can end with: NaN, infinite, a negative error;
/// but not one that the table leaves out.
bool has_failed(const ColumnAnalysis& column, std::size_t row);

/// Whether a row failed that none with a number is finer than: what is said is then of the others,
/// those of the same widths, as replicates are, too.
bool finest_failed(const DataAnalysis& analysis, const ColumnAnalysis& column);

/// vanishes_at_the_finest() of a column of errors.
bool vanishes_at_the_finest(const DataAnalysis& analysis, const ColumnAnalysis& column);

} // namespace tvbeam
