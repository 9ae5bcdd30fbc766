#pragma once

#include "mms/text/input_error.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace tvbeam {

/// A two-sided band that a figure of the result must lie in.
struct Expectation {
    enum class Figure {
        order,     ///< every observed order of a norm along a ladder
        ratio,     ///< error / printed figure, of one rung
        error,     ///< the error of one rung
        predicted, ///< error / prediction of the two-term model, both of the norm itself, of every
                   ///< rung finer than the grid
        p,
        q,
        a,
        b,
        rho,      ///< of the two-term fit
        constant, ///< the greatest constant of Corollary 2.2 over the grid
        named     ///< the figure of the study that is called `norm`
    };
    Figure figure = Figure::order;
    std::string study; ///< whose runs they are: "ladder", "orders", or as in MeasuredRuns
    std::string norm;
    std::size_t rung = 0; ///< for ratio and error
    double lowest = 0.0;
    double highest = 0.0;
    Place place; ///< where the scene says so
};

struct LadderBlock;
struct OrdersBlock;
struct WorkPrecisionBlock;
class TableReader;

/// Reads the block [expect]:
///
///     [expect.ladder.NORM]    orders = [lo, hi]; ratios = [lo, hi] or one such pair a rung; errors
///     = one a rung, with
///                             within = relative half-width of their bands (default 1e-3);
///                             predicted = [lo, hi]
///     [expect.orders.NORM]    p, q, a, b, rho = [lo, hi]; for corollary also constant = [lo, hi]
///     [expect.work_precision."SCHEME".NORM]    orders, errors, within as for a ladder
///     [expect.evolution], [expect.stress]      any of the figures() of their record = [lo, hi]
///
/// ladder, orders, timed: the scene's studies, or null; figured: those with figures(). Throws
/// InputError where a band has no width on a side, a norm is not measured, or a list does not have
/// one value a rung.
std::vector<Expectation> read_expectations(TableReader table, const LadderBlock* ladder,
                                           const OrdersBlock* orders,
                                           const WorkPrecisionBlock* timed,
                                           const std::vector<std::string>& figured = {});

} // namespace tvbeam
