/// What the columns of a table mean (data_file.hpp): which are widths, numbers of things, errors,
/// values and deviations.
#pragma once

#include "mms/text/input_error.hpp"
#include "studies/data/data_file.hpp"
#include "studies/data/printed_digits.hpp"

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tvbeam {

/// The names of all columns.
struct ColumnNames {
    std::vector<std::string> all;
    Place place; ///< of their line
    /// Those in which no record has anything: dt of what has no steps in time.
    std::set<std::size_t> blank = {};

    /// As it is written, or else in other cases of letters. Throws InputError where two are meant.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
    /// Throws InputError where there is none; option: by which another would be chosen.
    [[nodiscard]] std::size_t need(const std::string& name, const std::string& option) const;
    /// Those of a choice, one by one: a text that is no name is several with commas between them.
    [[nodiscard]] std::vector<std::string> apart(const std::vector<std::string>& texts) const;
};

/// How a column is read.
struct ColumnUse {
    std::size_t column = 0;
    bool is_width = false;
    double power = 1;       ///< the width is the number to this power
    bool is_step = false;   ///< in time
    bool is_unsaid = false; ///< the name of a width says neither width nor count
    bool may_count = false; ///< … or may count, where all are whole and grow: size, step
    DataColumn* target = nullptr;
    std::vector<double>* plain = nullptr;    ///< in place of it, of deviations
    std::vector<PrintedDigits> printed = {}; ///< one a record
    /// Of a count: whether one has no mark, and the first like 1.089, which beside it is 1089.
    bool has_plain = false;
    std::optional<std::pair<Place, std::string>> with_mark = {};

    [[nodiscard]] bool is_figure() const { return !is_width && plain == nullptr; }
};

/// The columns that a choice names, or those that need no name; adds them, empty, and what was
/// assumed to the data, which the result points into. Throws InputError at the line of names.
std::vector<ColumnUse> choose_columns(const ColumnNames& names, const DataChoice& choice,
                                      DataFile& data);

/// Sizes and steps whose names say neither width nor count: widths, which is said, or, where all
/// are whole, not known. Throws InputError there: what falls with the one grows with the other, and
/// by which it does a solver that converges is told from one that does not.
void require_sizes_that_are_known(const ColumnNames& names, const std::vector<ColumnUse>& uses,
                                  DataFile& data);

} // namespace tvbeam
