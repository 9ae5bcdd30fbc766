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
};

/// An order needs as many.
constexpr std::size_t fewest_levels = 3;

/// Rows with a logarithm; those of one cell are one row of their mean, and of the sum of their
/// weights 1/σ². A cell is one point of the widths, or, where there are too many rows, of a
/// lattice. Without σ it is taken from rows of one point, with Student's factor for their number.
TermRows usable_rows(std::span<const ErrorRow> given, std::size_t most_rows);

/// The widths that errors change with. Along another no two errors of rows that are equal in all
/// others differ by more than a part `most`, of two rows or more wherever there is one; and where
/// the others are finest of three or more, so that its term is seen to be small where it is the
/// largest part.
std::vector<Eigen::Index> moving_widths(const TermRows& rows, double most);

/// With these widths alone; rows that are equal in them are one, of their mean, as certain as they.
TermRows with_widths(const TermRows& rows, const std::vector<Eigen::Index>& widths);

/// ln of the coarsest width of each level, coarse to fine; a level is what lies within one factor.
std::vector<double> levels_of(Eigen::VectorXd log_widths, double one_level);

/// The level of a width: the last that is not finer; -1 where all are.
int level_of(const std::vector<double>& levels, double log_width);

} // namespace tvbeam
