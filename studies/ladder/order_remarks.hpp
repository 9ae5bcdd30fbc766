#pragma once

#include "studies/orders/observed_order.hpp"
#include "studies/orders/two_term_model.hpp"
#include "studies/runs/run.hpp"

#include <span>
#include <string>
#include <vector>

namespace tvbeam {

/// How well a fit of the two-term model knows its terms.
struct TermsKnown {
    double half_p = 0, half_q = 0; ///< halves of the 95 % intervals of its orders
    double part_a = 0, part_b = 0; ///< TwoTermFit::a_uncertainty and b_uncertainty

    /// Of 800 ladders beside grids whose terms have next ones, 1 of 340 sentences on sizes was
    /// untrue up to this, and 16 of 25 beyond; most of these on ladders whose errors the model has
    /// not.
    static constexpr double widest = 2;
    [[nodiscard]] bool knows_space() const { return part_a <= widest; }
    [[nodiscard]] bool knows_time() const { return part_b <= widest; }

    [[nodiscard]] bool has_sizes() const {
        constexpr double of_hidden_terms = 0.5;
        return part_a <= of_hidden_terms && part_b <= of_hidden_terms;
    }
    /// Terms at right angles have been fitted with correlations of −0.4.
    [[nodiscard]] static bool are_opposed(double rho) { return rho <= -0.5; }
};

/// What the orders of one norm along a ladder mean, in sentences. With a two-term model: which term
/// dominates, where the terms cancel, and which order the ladder shows in the end. Without: the
/// range that the pairwise orders keep, and where they leave it by more than 0.15. Nothing for
/// fewer than two orders. Also that a level between others has no error at all. roots: the records
/// of the norm itself, also where the table shows its square; orders in the text are the table's.
/// terms: of orders that their intervals do not tell apart nothing is said past the ladder, and of
/// the size of a term nothing that is not known: where the model has it so small that the other
/// dominates in any case, that it is hidden; else that how large it is is not known. is_explained:
/// no reason is guessed, as one is said elsewhere, or the scheme is known to be wrong.
std::vector<std::string> order_remarks(const Measure& norm, std::span<const Refinement> roots,
                                       const TwoTermModel* model, bool is_explained = false,
                                       const TermsKnown& terms = {});

} // namespace tvbeam
