#pragma once

#include "studies/observed_order.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Reads records for an order analysis from a CSV file whose first line names the columns: h (or
/// elements, then h = 1/elements), dt, the error, and seconds. h or dt may be absent; seconds may;
/// other columns are passed over. An empty or `nan` field is a failed run.
///
/// error_column: the column of the error; without it `error`, or else the only one that is left.
/// Throws InputError at file:line:column for a missing file or column, a field that is not a
/// number, a width that is not positive, and a line with too few or too many fields.
std::vector<Refinement> read_records(const std::string& file,
                                     const std::optional<std::string>& error_column);

} // namespace tvbeam
