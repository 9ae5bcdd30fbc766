#pragma once

#include <string>
#include <string_view>

namespace tvbeam {

/// How large the numbers in each column of CSV are, or of data for plots, for the record of what a
/// program wrote: 1 plus the mean of ln(1 + |v|/1e-6), of negative ones 0.7 of it, which tells
/// columns apart and does not see rounding. Rows between lines without numbers are one block, which
/// counts as one however many rows it has: the points of a curve are as many as it took. Blocks and
/// their rows count from 1 to 2, so that none stands for another. " 7.123 4.200"; without a column
/// "seconds" or "sec", and nothing of a file that has other times. Held to
/// 0.1 %, as numbers in sentences are, it shows one of ten numbers that is a tenth larger, and one
/// of a hundred that is three times as large; what is below 1e-9 is alike.
std::string column_sizes(std::string_view text);

} // namespace tvbeam
