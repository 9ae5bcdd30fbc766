/// Pairwise observed orders of a ladder of refinements.
///
/// One record is one run of any solver: its mesh width h, its time step Δt, the error it made.
/// Between a record and the one before it the observed order is
///
///     p_i = ln(e_{i−1} / e_i) / ln r_i,      r_i = h_{i−1} / h_i, or Δt_{i−1} / Δt_i,
///
/// with its sign: p_i < 0 says that the error grew under refinement. An order is never replaced by
/// its absolute value, by zero or by NaN: where it has no value there is none.
///
/// A norm and its square are both fine here, the square having twice the order; the analyses that
/// add up error terms (two_term_model.hpp) want the norm itself.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

/// Whether a width or an error has a logarithm.
inline bool is_positive(double value) {
    return std::isfinite(value) && value > 0;
}

struct Refinement {
    /// mesh width; NaN where the records have none
    double h = std::numeric_limits<double>::quiet_NaN();
    /// time step; NaN where the records have none
    double dt = std::numeric_limits<double>::quiet_NaN();
    /// a norm of the error, ≥ 0; NaN marks a run that failed
    double error = std::numeric_limits<double>::quiet_NaN();
    /// what the run cost; NaN where it was not measured. No order depends on it.
    double seconds = std::numeric_limits<double>::quiet_NaN();
    /// the part of the error that is uncertain for a reason that refinement does not know of, as
    /// quadrature that does not resolve what it integrates; ≥ 0. No order depends on it.
    double uncertainty = 0.0;

    /// Whether the error is known well enough to show an order: to one per cent.
    [[nodiscard]] bool is_resolved() const { return uncertainty <= 0.01; }
};

/// r > 1 where `to` is finer than `from`, r < 1 where it is coarser. The ratio of h where h
/// changes, else that of Δt. Where both change by different ratios (Δt ∝ h², say) it is still h's,
/// so that the order is one in h along the ladder's own coupling. None where neither changes,
/// where one grows and the other shrinks, or where a width that is there in one record is missing,
/// not finite or not positive in the other.
std::optional<double> refinement_ratio(const Refinement& from, const Refinement& to);

/// As many values as records. None for the first record, and wherever one of the two errors is
/// zero, negative or not finite, or there is no refinement ratio.
std::vector<std::optional<double>> observed_orders(std::span<const Refinement> ladder);

} // namespace tvbeam
