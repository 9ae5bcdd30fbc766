#pragma once

#include "studies/orders/extrapolation.hpp"
#include "studies/orders/observed_order.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What a file holds: errors, or where it has none a computed number for each width.
struct RecordFile {
    std::vector<Refinement> records;
    std::vector<GridValue> values; ///< width and value of each row; empty where there are errors
};

/// Reads records for an order analysis from a CSV file whose first line names the columns: h (or
/// elements, then h = 1/elements), dt, the error, and seconds. h or dt may be absent; seconds may;
/// other columns are passed over. Empty lines and lines that begin with # are passed over too, also
/// above the first line, and so is a byte-order mark. An empty or `nan` field is a failed run; a
/// number too small for a double is 0.
///
/// error_column: the column of the error; without it `error`. Where neither is there a column
/// `value` is read, a number that was computed at each h, or at each dt where h stays; there is one
/// a width, and h and dt are not refined in turns.
/// Throws InputError at file:line for a missing file or column, a column that is wanted and named
/// twice, a field that is not a number or too large for one, a width that is not positive, and a
/// line with too few or too many fields.
RecordFile read_records(const std::string& file, const std::optional<std::string>& error_column);

} // namespace tvbeam
