/// The error of a scheme in space and time as the norm of a sum of two terms.
///
/// The error is, to leading order, h^p A + Δt^q B with two fixed fields A and B. A norm that comes
/// from an inner product sees their sizes a = ‖A‖, b = ‖B‖ and the cosine of the angle between
/// them, ρ = (A, B) / (a b), and nothing else:
///
///     e² = a² h^{2p} + 2 ρ a b h^p Δt^q + b² Δt^{2q},      −1 ≤ ρ ≤ 1.
///
/// ρ < 0 is a cancellation: where the two terms are equally large the norm is only
/// sqrt((1 + ρ) / 2) times their sum, and a ladder that passes there shows orders of neither term.
///
/// e is the norm itself. Of a squared norm take the root first. For a maximum over time of norms,
/// whose maximum moves between instants, the model is an approximation.
#pragma once

#include "studies/orders/observed_order.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

struct TwoTermModel {
    double a = 0; ///< 0: no term in h is seen
    double p = 0;
    double b = 0; ///< 0: no term in Δt is seen
    double q = 0;
    double rho = 0;

    double spatial(double h) const;   ///< a h^p ≥ 0
    double temporal(double dt) const; ///< b Δt^q ≥ 0
    double error(double h, double dt) const;
};

/// What is measured of the model's error against a run that stands in for the exact solution: the
/// model with a (h^p − h_ref^p) and b (Δt^q − Δt_ref^q) for its two terms. A width of the reference
/// that is NaN: exact in that width.
double error_against(const Refinement& reference, const TwoTermModel& model, double h, double dt);

enum class Dominant { space, time, both, cancellation };

/// A record is in the cancellation where the cross term takes the norm below this part of the
/// larger term.
inline constexpr double cancellation_depth = 0.9;

struct ForecastRow {
    double h = 0;
    double dt = 0;
    double spatial = 0;
    double temporal = 0;
    double error = 0;
    Dominant dominant = Dominant::space;
    /// the order that a table shows in this row, as observed_orders has it; none in the first
    std::optional<double> order = std::nullopt;
};

/// What the model says of a ladder. Past its last row the ladder is carried on by the ratios of its
/// last two.
struct LadderForecast {
    std::vector<ForecastRow> rows; ///< those of the ladder

    /// The orders of the two terms along the ladder, in the width that observed_orders uses: for
    /// Δt ∝ h these are p and q, for Δt ∝ h² they are p and 2q, for fixed h they are 0 and q.
    double spatial_order = 0;
    double temporal_order = 0;
    /// The lesser of the two: what the ladder shows in the end.
    double asymptotic_order = 0;
    Dominant asymptotic_dominant = Dominant::both; ///< never cancellation

    /// The first row from which on every order is within the tolerance of the asymptotic one; the
    /// order into the first is that from a level before it.
    /// It may lie past the ladder (row ≥ rows.size()); h and dt say where. None where it lies more
    /// than `furthest_row` rows on, or the errors of the ladder have no order.
    struct Place {
        std::size_t row = 0;
        double h = 0;
        double dt = 0;
    };
    std::optional<Place> asymptotic_from;

    /// Where the two terms are equally large and ρ < 0: the middle of the cancellation, `row` being
    /// the last row before it. None where the ladder does not come across it, in its rows or
    /// carried on.
    std::optional<Place> cancellation;

    static constexpr std::size_t furthest_row = 60;
};

/// The ladder gives the widths, coarse to fine; its errors are not looked at. `tolerance` is
/// relative to the asymptotic order. A forecast of fewer than two rows, or of rows without
/// refinement ratio, has its rows and nothing else. std::invalid_argument where a width is not
/// positive.
LadderForecast forecast(const TwoTermModel& model, std::span<const Refinement> ladder,
                        double tolerance = 0.1);

} // namespace tvbeam
