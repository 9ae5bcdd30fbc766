/// The two-term model fitted to a given set of points, without a judgement on any of them.
///
/// The search runs in θ = (ln a h_c^p, p, ln b Δt_c^q, q, φ) with ρ = sin φ and the geometric means
/// h_c, Δt_c of the widths: all of θ is free, and sizes are hardly correlated with orders. For
/// given p and q the squares e² are linear in (a², 2ρab, b²), so a coarse net of orders gives good
/// starts at the cost of small linear problems.
#pragma once

#include "studies/orders/least_squares.hpp"
#include "studies/orders/two_term_model.hpp"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace tvbeam {

/// ln of one width of every point. A grid has fewer widths than points: what depends on one width
/// alone is computed once for each level.
struct LogWidths {
    Eigen::VectorXd levels;                ///< without repetition, ascending
    Eigen::VectorX<Eigen::Index> level_of; ///< of each point

    static LogWidths of(const Eigen::VectorXd& log_widths);
    double operator[](Eigen::Index point) const { return levels[level_of[point]]; }
    Eigen::VectorXd at_points() const { return levels(level_of); }
};

/// Points as the regression wants them, all of one length.
struct TwoTermPoints {
    LogWidths log_h;           ///< ln h/h_c
    LogWidths log_dt;          ///< ln Δt/Δt_c
    Eigen::VectorXd log_error; ///< ln e
    Eigen::VectorXd weights;
    double log_h_centre = 0;  ///< ln h_c
    double log_dt_centre = 0; ///< ln Δt_c
    /// Widths of the reference run, as the points' own; none where the solution is known. Then the
    /// terms are a (h^p − h_ref^p) and b (Δt^q − Δt_ref^q).
    std::optional<double> reference_log_h = std::nullopt;
    std::optional<double> reference_log_dt = std::nullopt;
    /// Two parameters more, c and d, for the next terms of the two series: a h^p (1 + c (h/h_c)^k),
    /// b Δt^q (1 + d (Δt/Δt_c)^l), with these k and l. They are no part of the model; what they do
    /// to p and q is what the model without them is biased by.
    struct NextTerms {
        double in_h = 1;
        double in_dt = 1;
    };
    std::optional<NextTerms> next_terms = std::nullopt;
    /// ρ held at ±1, with four parameters left: there sin φ has no derivative, and nothing an
    /// interval.
    std::optional<double> fixed_rho = std::nullopt;

    Eigen::Index size() const { return log_error.size(); }
    TwoTermPoints subset(const std::vector<Eigen::Index>& chosen) const;
};

inline constexpr int two_term_parameters = 5;
inline constexpr int next_term_parameters = 2;

/// The best of several starts, or the one that `warm_start` leads to. None where no start comes to
/// an end. θ and its covariance have four entries where ρ is held, else five.
std::optional<LeastSquares>
two_term_regression(const TwoTermPoints& points,
                    const std::optional<Eigen::VectorXd>& warm_start = std::nullopt);

/// ln e of the model at θ, and its derivatives by θ, at every point; NaN where the model has no
/// error there.
void two_term_values(const TwoTermPoints& points, const Eigen::VectorXd& theta,
                     Eigen::VectorXd& values, Eigen::MatrixXd* jacobian);

/// θ in the model's own symbols.
TwoTermModel two_term_model(const TwoTermPoints& points, const Eigen::VectorXd& theta);

/// cov θ carried to (ln a, p, ln b, q, ρ); zero for a ρ that is held.
Eigen::MatrixXd two_term_covariance(const TwoTermPoints& points, const LeastSquares& fit);

} // namespace tvbeam
