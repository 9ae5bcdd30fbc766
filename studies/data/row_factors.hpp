/// Columns that are no width and no figure and yet tell rows apart, as the scheme, the degree of
/// the elements or the time of an error does: factors, in the words of statistics. Rows of two
/// schemes are no replicates of each other, and no ladder.
#pragma once

#include "mms/text/input_error.hpp"
#include "studies/data/data_columns.hpp"
#include "studies/data/data_file.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// What DataChoice::where asks of a column.
struct RowCondition {
    std::size_t column = 0;
    std::string name;
    std::string text;                   ///< "*": anything
    std::vector<std::string> seen = {}; ///< the first different texts

    /// Whether a field has the text, or is the same number, as field_number.hpp reads both.
    bool holds_for(std::string_view field, char separator);
};

/// Throws InputError for what is not COLUMN=TEXT, for columns that are not there, and those that
/// are named twice.
std::vector<RowCondition> conditions_of(const ColumnNames& names,
                                        const std::vector<std::string>& where);

/// DataFile::chosen. separator: of fields, as for holds_for().
std::vector<std::string> chosen_by(const std::vector<RowCondition>& conditions, char separator);

/// Adds to the data's remarks which rows were chosen. Throws InputError where there are none.
void require_records(DataFile& data, const Place& names,
                     const std::vector<RowCondition>& conditions);

/// What a column may tell beside a series.
enum class Told {
    series,     ///< rows of one value and those of another may be two
    replicates, ///< they are of one, at equal widths its scatter
    times,      ///< of several where they are of the same widths, else of one that took long
    outcome     ///< what a run shows of itself
};

/// A column that nothing reads.
struct UnreadColumn {
    std::size_t column = 0;
    std::string name;
    std::vector<std::string_view> texts = {};        ///< one a record
    std::vector<std::optional<double>> numbers = {}; ///< what these are; none where they are none
    Told told = Told::series;                        ///< by its name
};

/// All columns but those that are used, named by a condition, or by their names what a run shows of
/// itself, as seconds.
std::vector<UnreadColumn> unread_columns(const ColumnNames& names,
                                         const std::vector<ColumnUse>& uses,
                                         const std::vector<RowCondition>& conditions);

/// Throws InputError where the rows are of two series: where a column has one value at two widths
/// or more and another at two of the same; one number at three and another, and the ranges of both
/// overlap; or one text and another, and the ranges overlap, or both refine all that the table
/// does. Only records with a figure count. Adds to the data's remarks which texts, each of some
/// rows and not enough to be a series, are read together, and those of replicates.
void require_one_series(DataFile& data, const Place& names,
                        const std::vector<UnreadColumn>& columns);

} // namespace tvbeam
