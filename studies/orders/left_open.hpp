/// Which orders the digits leave open that a sequence's errors are printed to.
#pragma once

#include "studies/orders/term_model.hpp"

namespace tvbeam {

/// How far from an order the farthest is with which a leading term and a next one follow all rows
/// as closely as the digits ask that they were printed to: A h^p (1 + c (h/h_f)^k), the next term
/// no larger than the leading one at h_f, and a quarter of an order to a half on; where the digits
/// show that the order moves, so that a leading term alone does not follow them, up to two orders
/// on. Of orders up to one away: an interval that reaches so far says nothing. 0 where no such
/// terms follow the rows, of three rows, which terms of so many numbers always follow, of scatter
/// that is not that of rounding, and of more than one width.
/// log_finest: ln h_f where the digits show the finest error; NaN, and else: of the finest that
/// they show.
double distance_left_open(const TermRows& rows, double log_finest, double order);

} // namespace tvbeam
