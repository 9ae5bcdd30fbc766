/// Rows of errors as fits want them, and the levels of their widths.
#pragma once

#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace tvbeam {

/// One run, or one row of a table.
struct ErrorRow {
    std::vector<double> widths;                              ///< as many in every row; positive
    double error = std::numeric_limits<double>::quiet_NaN(); ///< a norm, not its square
    /// Standard deviation of ln e, that is of the error over itself. NaN: unknown; counts only
    /// where all rows with an error have one.
    double sigma = std::numeric_limits<double>::quiet_NaN();
    bool rounded = false; ///< σ is what rounding to the digits printed makes
};

/// An order needs as many.
constexpr std::size_t fewest_levels = 3;

/// Whether an error is zero that no row with another is as fine as in all widths, though no other
/// has come near to rounding: that is no power of the widths, and what a run shows that is compared
/// with itself. No gate on an order holds beside it.
bool vanishes_at_the_finest(std::span<const ErrorRow> rows);
inline constexpr const char* finest_is_zero = "the error of the finest run is zero";

/// In which rows of a grid terms cancel until rounding is left of them: such an error is rounding
/// beside most of the errors, and beside one of a row that is as fine.
std::vector<bool> cancelled_rows(std::span<const ErrorRow> rows);

/// Rows with a logarithm, but those of a grid that are cancelled; those of one cell are one row of
/// their mean, and of the sum of their weights 1/σ². A cell is one point of the widths, or, where
/// there are too many rows, of a lattice. Without σ it is taken from rows of one point, with
/// Student's factor for their number.
TermRows usable_rows(std::span<const ErrorRow> given, std::size_t most_rows);

/// The widths that errors change with. Along another no two errors of rows that are equal in all
/// others differ by more than a part `most`, of two rows or more wherever there is one; and where
/// the others are finest of three or more, so that its term is seen to be small where it is the
/// largest part.
std::vector<Eigen::Index> moving_widths(const TermRows& rows, double most);

/// With these widths alone; rows that are equal in them are one, of their mean, as certain as they.
TermRows with_widths(const TermRows& rows, const std::vector<Eigen::Index>& widths);

/// Whether two widths are refined apart from each other: not one after the other, nor each from one
/// point, so that their levels that stand together make a tree. What the terms of the two do
/// together, of three widths, is not known of those.
bool are_refined_apart(const TermRows& rows, const std::vector<std::vector<double>>& levels,
                       Eigen::Index first, Eigen::Index second);

/// ln of the coarsest width of each level, coarse to fine; a level is what lies within one factor.
std::vector<double> levels_of(Eigen::VectorXd log_widths, double one_level);

/// The level of a width: the last that is not finer; -1 where all are.
int level_of(const std::vector<double>& levels, double log_width);

} // namespace tvbeam
