#pragma once

#include "studies/orders/observed_order.hpp"
#include "studies/orders/two_term_model.hpp"
#include "studies/runs/run.hpp"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// What the orders of one norm along a ladder mean, in sentences. With a two-term model: which term
/// dominates, where the terms cancel, and which order the ladder shows in the end. Without: the
/// range that the pairwise orders keep, and where they leave it by more than 0.15. Nothing for
/// fewer than two orders. Also that a level between others has no error at all. roots: the records
/// of the norm itself, also where the table shows its square; orders in the text are the table's.
/// halves: of the 95 % intervals of the model's p and q; of orders that these do not tell apart
/// nothing is said past the ladder. is_explained: no reason is guessed, as one is said elsewhere,
/// or the scheme is known to be wrong.
std::vector<std::string> order_remarks(const Measure& norm, std::span<const Refinement> roots,
                                       const TwoTermModel* model, bool is_explained = false,
                                       std::pair<double, double> halves = {});

} // namespace tvbeam
