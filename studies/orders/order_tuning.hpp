/// The constants of the engine of orders.
#pragma once

#include <cstddef>
#include <limits>

namespace tvbeam {

/// Down to `most_rows` set on one half of the grids that tests/orders/grids makes, and scored on
/// the other, but for `grid`; those after it on errors made up of exponentials, and of powers on
/// three levels, and scored on other seeds: see the README there.
struct OrderTuning {
    /// Half of an interval wider than this says nothing: the order is not determined. Half of the
    /// distance between orders of methods.
    double widest = 0.5;
    /// A term that is a smaller part of the error in every row is hidden: next terms of the others
    /// are as large, and its order would be theirs.
    double least_share = 0.15;
    /// Residuals of grids from this on may be scatter that nobody stated, if no window has any that
    /// are that many times less. On grids with next terms in both widths and 0.3 and 2 % of scatter
    /// 34 of 267 determined orders missed without it, 10 of 224 with it; to reach slow terms as
    /// well leaves 6 of 205, and made intervals of the solver's grids up to four times as wide.
    double least_seen_scatter = 3e-4;
    double as_in_windows = 3; ///< see least_seen_scatter
    /// Added to half the interval: what no change of window or model shows. An order that changes
    /// by less from window to window stands still.
    double narrowest = 0.01;
    /// Half of a grid's interval over the spread. 1.2 of 1, 1.1, 1.2, 1.3 and 1.5, after a look at
    /// all three older sets of grids; 1.4 of 1.2, 1.4 and 1.6 when half orders, logarithms and
    /// constants came in, for the shipped solutions, of which 94.9 % held with 1.2: a choice that
    /// is not free of those. The two fresh sets had no say in it.
    double grid = 1.4;
    /// … and this much wider under scatter, which more models follow. Of 1, 1.25, 1.5 and 2
    /// on tables of grids in two digits, those of tests/studies/records.cpp among them.
    double scattered = 1.5;
    /// … and this much wider where some width has three levels alone: no window leaves one out, and
    /// all that is seen of its drift is what models with a next term change.
    double three_levels = 2.5;
    /// Half of a sequence's interval over the spread: its windows are few and share their finest
    /// rows.
    double sequence = 3.0;
    /// … and this much wider, over the square of the levels less two, where these are few.
    double few_levels = 4.0;
    /// Drift that known scatter may hide, over the standard error of a window's order. On made-up
    /// tables of 3 to 6 levels with a next term half an order or one nearer and 0.1 to 3 % of
    /// scatter, which it was not tuned on, 105 of 1782 intervals miss (5.9 %), 146 of 1856 without
    /// it. More would leave more undetermined that is a power alone.
    double hidden_drift = 0.35;
    /// Residuals of all rows of a sequence of close levels that are so many times what is known of
    /// its scatter show more, and its intervals hold what they would be with that, too. Of h^p (1 +
    /// c h), c = 0 or -1 … 2, on four to eight levels with 0.1 to 5 % of scatter that nobody
    /// states, of a seed that nothing was chosen with, 45 of 1114 intervals missed without it in
    /// the ratio 1.25 (31 of 493 on four or five levels) and 38 of 1453 in 1.5, and 3 of 780 (3 of
    /// 318) and 5 of 1245 do with it. In the ratio 2 it was 17 of 1642: these are left alone.
    /// Infinite: it is not looked for.
    double contradicted = 3;
    /// A member that is uncertain by u counts for 1 / (1 + (u / this)²) of one: each adds its u_m²
    /// over itself to half², and whether a fit that determines nothing has an infinite error or one
    /// of a million is a matter of rounding.
    double says_nothing = 10;
    /// Added to u_m in the weights: models do not agree better than by chance.
    double agreement = 0.002;
    /// Against a reference, what takes off its error in one way does not count beside another that
    /// is less uncertain by this factor: of 30 grids against one four times finer the 196
    /// determined orders in h all hold the true one, where 10 of 196 missed it with the errors
    /// taken off as smooth ones alone.
    double drifts_from_reference = 5;
    /// Widths within this factor are one level: an order read between them is noise. Scatter of 1 %
    /// makes an order between them uncertain by 0.12.
    double one_level = 1.12;
    /// More rows than this are averaged over cells of a lattice in ln of the widths: only time
    /// depends on it.
    std::size_t most_rows = 400;
    /// The smallest part of an error that shows a term.
    double seen = 0.01;
    /// Orders of terms that a method may have: without a bound next terms follow exp(−1/h), too (20
    /// of 200 grids of it). With 0.25 in place of 0.4 one of 150 and one of 100 such grids had an
    /// order.
    double least_order = 0.4;
    double greatest_order = 20; ///< see least_order
    /// A model explains a rise of the local orders that it has within this, and scatter besides.
    /// With 0.02 and 0.03 nothing changed on 2160 grids of 101 … 159 and 1224 of the shipped
    /// solutions.
    double explained = 0.05;
    /// … and whose next term leaves this part of the leading one on the coarsest level: further
    /// terms would be as large as one that takes off more.
    double least_left = 0.2;
    /// Orders above this are to be seen at three levels: a method of order six is below it with its
    /// interval, what two levels show of exp(−1/h) mostly above.
    double steep = 6.5;
    /// A term of an order nearer to zero than this stands still while its width falls.
    double constant = 0.1;
    /// Models whose scatters are within this factor follow the rows about as closely. Of 2 and 5 on
    /// grids of three levels the second missed fewer, and left as many undetermined.
    double about_as_closely = 5;
    /// A model follows rows that stand off it by no more than this (root of mean square), or thrice
    /// known scatter.
    double followed = 0.15;
    /// Leading terms alone that follow all rows to so small a part of the least of them are those
    /// that there are; and models with next terms that do so to the second. Of 250 grids of the
    /// beam with great couplings 30 more orders missed, of 911 in dt, without these two: leading
    /// terms alone stand off by 2.8e-4 there or more, models with next terms by 1e-6. Next terms
    /// 0.1 to 0.4 of an order on are followed by leading terms to 5e-5 of their own.
    double followed_by_leading_terms = 1e-5;
    double followed_to_rounding = 1e-8; ///< see followed_by_leading_terms
    /// Errors that differ by no more than this part show no other term beside them.
    double unchanged = 0.1;
    /// What other widths leave of an error where they are finest is known well enough to be taken
    /// off up to this part of it.
    double others_left = 0.3;
    /// A width that changes no error by more than this part is left out: what the orders of others
    /// could owe to it is far below `narrowest`.
    double idle = 1e-4;
    /// ln of the width at which next terms are no larger than leading ones: where errors are steps
    /// between values, that of the finest value. NaN: that of the finest error.
    double log_finest = std::numeric_limits<double>::quiet_NaN();
    bool of_steps = false; ///< errors are steps between values, and reasons are said of these
};

} // namespace tvbeam
