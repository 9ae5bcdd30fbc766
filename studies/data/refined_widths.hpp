/// How the widths of a table change from row to row: which are refined, which together, which stand
/// still. Rows are from coarse to fine (DataAnalysis::widths).
#pragma once

#include "studies/data/data_file.hpp"
#include "studies/orders/order_engine.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

bool varies(const std::vector<double>& numbers);

/// The places of the widths that are refined.
std::vector<std::size_t> refined(const std::vector<DataColumn>& widths);

/// Whether of two widths none changes without the other: one has a value to each of the other, and
/// grows with it, or falls, but for a few rows; drawn apart, they do neither.
bool change_together(const DataColumn& first, const DataColumn& second);

/// Whether two of the widths are refined that do not change together.
bool are_a_grid(const std::vector<DataColumn>& widths);

/// Of a width that changes together with another one.
std::string together_with(const DataColumn& other, const DataColumn& width);

/// Of two widths that are refined together the first stands for both, unless the second is refined
/// so much more that no method couples them so.
void put_the_refined_first(const std::vector<DataColumn>& widths, std::vector<std::size_t>& used);

/// The one that stands for all: the first that is refined, as put_the_refined_first has it.
std::size_t leading_width(const std::vector<DataColumn>& widths);

/// The widths of the rows that have a number.
std::vector<double> of_rows_with_numbers(const std::vector<double>& widths,
                                         const std::vector<double>& numbers);

/// Whether a width is the same in all rows that have a number, or as good as that.
bool is_held(const DataColumn& width, const DataColumn& along, const std::vector<double>& numbers);

/// The width at which one that coarser rows refine stands still where the finest refine another;
/// none where it does not. Of the rows that have a number.
std::optional<double> standing_still(const DataColumn& width, const DataColumn& along,
                                     const std::vector<double>& numbers);

/// How a width changes with the one that rows are refined along.
std::string path_words(const DataColumn& width, const DataColumn& along,
                       const std::vector<double>& numbers);

/// Whether finer rows by the width `along` are nowhere coarser by another, and rows of one such
/// width are of one width throughout, so that it stands for all.
bool is_one_path(const std::vector<DataColumn>& widths, std::size_t along);

std::string order_words(const std::string& width, const OrderInterval& order);

} // namespace tvbeam
