/// The two-term model fitted to a grid of runs, with the window of records that it holds for.
///
/// Fitted on ln e by weighted least squares, in a window that is found in two steps.
///
/// First, records that are plainly out of line: a forward search (Atkinson and Riani, 2000) starts
/// from the half that is fitted best (least trimmed squares, Rousseeuw 1984; the finest half,
/// unless another agrees far better with itself) and grows by the record nearest to the model. It
/// takes all records unless one stands further off than Student's t lets it at 0.2 % for the lot,
/// and by about five per cent. Then it ends where the intervals of p and q are narrowest.
///
/// Then the coarse edges of the grid, which higher-order terms bend by little: the coarsest h, the
/// coarsest Δt or both are taken off, again and again, where an F test at 0.2 % finds them
/// inconsistent with what is finer and the orders are better known without them.
///
/// What is outside is named, with the reason.
///
/// Data that need only one term get only one: where an F test at 1 % finds no use for the other,
/// its size is zero, and its order has no value and an infinite standard error.
#pragma once

#include "studies/orders/two_term_model.hpp"

#include <Eigen/Core>

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
    floor,          ///< a coarser record has no greater error, where the model shrinks
    pre_asymptotic, ///< as coarse as the coarsest record used, or coarser
    too_fine,       ///< the model is smallest there, and the error shrinks more slowly
    outlier         ///< none of these: among the records used, and not in line
};

/// The reason in words, as of several records: "no error", "too coarse for the model", …
const char* words_for(Rejection why);

struct RejectedRecord {
    std::size_t record = 0;
    Rejection why = Rejection::failed;
    std::string reason; ///< words_for(why), and the figures of this record
};

struct TwoTermOptions {
    /// h and dt of a reference run that stands in for the exact solution; NaN in one of them: the
    /// records are exact in that width. Its own error is part of the model: a (h^p − h_ref^p), b
    /// (Δt^q − Δt_ref^q).
    std::optional<Refinement> reference = std::nullopt;
    /// Relative weight of each record: 1 / variance of ln e, up to a factor. Empty: all one.
    std::span<const double> weights = {};
    /// Use every finite, positive record, and reject none.
    bool all_records = false;
};

struct TwoTermFit {
    TwoTermModel model; ///< of the error itself, against the exact solution
    /// Why there is no model; empty where there is one.
    std::string failure;

    /// Of (ln a, p, ln b, q, ρ). Infinite where the records do not determine a value.
    Eigen::MatrixXd covariance;
    double log_a_se = std::numeric_limits<double>::infinity();
    double p_se = std::numeric_limits<double>::infinity();
    double log_b_se = std::numeric_limits<double>::infinity();
    double q_se = std::numeric_limits<double>::infinity();
    double rho_se = std::numeric_limits<double>::infinity(); ///< 0 where ρ is held at ±1
    /// halves of the 95 % Student intervals
    double p_half_width = std::numeric_limits<double>::infinity();
    double q_half_width = std::numeric_limits<double>::infinity();

    /// How far the orders lie from those of a fit that has next terms too, a h^p (1 + c h^k) and b
    /// Δt^q (1 + d Δt^l) with k, l of 1 or 2: a bias that no residual shows. 0 where an F test at
    /// 0.2 % finds no next terms, and for a term whose size is zero.
    double p_drift = 0;
    double q_drift = 0;

    /// By how much ln e changes over the used h at one Δt, and over the used Δt at one h, where
    /// that is most; and the greatest part of the error that is a h^p, or b Δt^q.
    double change_by_h = 0;
    double change_by_dt = 0;
    double share_of_h = 0;
    double share_of_dt = 0;

    int dof = 0;
    double rms = 0; ///< sqrt(χ² / dof), of the records used
    /// ln e − ln model, for every record; NaN where the record has no logarithm
    std::vector<double> residuals;
    std::vector<std::size_t> used;
    std::vector<RejectedRecord> rejected;

    /// What to quote behind ±: sampling error and bias, one on top of the other.
    double p_uncertainty() const { return p_half_width + p_drift; }
    double q_uncertainty() const { return q_half_width + q_drift; }

    /// Do the records determine the order? It is positive and known to ±0.5 or better, and
    ///   – its width moves the errors: ln e changes by more than 10 max(rms, 0.002). A term that
    ///     hardly changes along its own width is fitted to what the other term leaves over, its
    ///     next term above all, and the interval, which takes the model for true, does not know of
    ///     it;
    ///   – the other term, where it does not move the errors either way, is less than a twentieth
    ///   of
    ///     them. A larger one stands in for a next term of this one, and this order bends with it.
    /// An order that is not determined is not to be quoted as a number.
    bool p_determined() const;
    bool q_determined() const;
    static constexpr double widest_uncertainty = 0.5;
    static constexpr double least_change = 10;    ///< in units of the scatter
    static constexpr double least_scatter = 2e-3; ///< what next terms bend even a smooth fit by
    static constexpr double harmless_share = 0.05;

    bool holds() const { return failure.empty(); }
};

/// Needs seven finite, positive records in three h and three Δt; with fewer the fit says so in
/// `failure`. std::invalid_argument for weights that are not one positive number a record, and a
/// reference that is not at least as fine as every record.
TwoTermFit fit_two_term(std::span<const Refinement> records, const TwoTermOptions& options = {});

} // namespace tvbeam
