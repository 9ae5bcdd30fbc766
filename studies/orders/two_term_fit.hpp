/// The two-term model of a grid of runs (two_term_model.hpp), with orders and intervals from the
/// engine (order_engine.hpp).
///
/// p and q are the engine's. The sizes and ρ are those of the leading terms alone, fitted to the
/// window of rows in which their orders are steadiest, with sizes that make a h^p and b Δt^q the
/// fitted terms in the middle of that window. A term that is hidden in every row has the size zero
/// and no order. Rows before the window and rows far out of line with the fit are named, with the
/// reason.
#pragma once

#include "studies/orders/order_engine.hpp"
#include "studies/orders/two_term_model.hpp"
#include "studies/orders/verdict.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tvbeam {

enum class Rejection {
    failed,
    unresolved, ///< quadrature leaves the error uncertain
    exact,
    pre_asymptotic, ///< coarser than the window
    outlier         ///< in the window, and not in line
};

/// The reason in words, as of several records: "no error", "coarser than the window of the fit", …
const char* words_for(Rejection why);
/// The same as a verdict on the row.
Verdict verdict_of(Rejection why);

struct RejectedRecord {
    std::size_t record = 0;
    Rejection why = Rejection::failed;
    std::string reason; ///< words_for(why), and the figures of this record
};

struct TwoTermFit {
    TwoTermModel model; ///< of the error itself, against the exact solution
    /// Why there is no model; empty where there is one.
    std::string failure;
    /// Why the leading terms alone are none, though a model with next terms, a logarithm or a
    /// constant has orders: a, b and ρ then stand for nothing. Empty where they fit.
    std::string misfit = {};
    std::optional<OrderEnsemble> ensemble;
    OrderInterval p;
    OrderInterval q;
    /// By what part of a and of b their 95 % intervals (OrderEnsemble::size) reach from them at
    /// most; infinite where they are not determined.
    double a_uncertainty = std::numeric_limits<double>::infinity();
    double b_uncertainty = std::numeric_limits<double>::infinity();

    /// Standard errors of the one fit that the sizes come from; infinite where the records do not
    /// determine a value.
    double p_se = std::numeric_limits<double>::infinity();
    double q_se = std::numeric_limits<double>::infinity();
    double rho_se = std::numeric_limits<double>::infinity();
    double rms = 0; ///< sqrt(χ² / dof) of that fit: the scatter of ln e
    std::vector<std::size_t> used;
    std::vector<RejectedRecord> rejected;

    /// Halves of the 95 % intervals.
    double p_uncertainty() const { return p.half_width(); }
    double q_uncertainty() const { return q.half_width(); }
    /// An order that is not determined is not to be quoted as a number.
    bool p_determined() const { return p.determined; }
    bool q_determined() const { return q.determined; }
    bool holds() const { return failure.empty(); }
    bool has_sizes() const { return holds() && misfit.empty(); }
    /// Both orders are determined: the model predicts, with intervals of its own.
    bool predicts() const { return has_sizes() && p.determined && q.determined; }
    /// Known to less than a factor of two, as their orders are.
    bool a_known() const { return has_sizes() && p.determined && a_uncertainty < 1; }
    bool b_known() const { return has_sizes() && q.determined && b_uncertainty < 1; }
    /// Both, and ρ with them.
    bool is_known() const { return a_known() && b_known(); }
};

/// Needs seven finite, positive records in three h and three Δt; with fewer the fit says so in
/// `failure`. reference: h and dt of a run that stands in for the exact solution; NaN in one of
/// them: the records are exact in that width. sigma: standard deviations of the errors, one a
/// record; empty where they are not known. std::invalid_argument where the reference is not at
/// least as fine as every record.
TwoTermFit fit_two_term(std::span<const Refinement> records,
                        const std::optional<Refinement>& reference = std::nullopt,
                        const std::vector<double>& sigma = {});

} // namespace tvbeam
