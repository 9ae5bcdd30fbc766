/// The error of a scheme as the norm of a sum of terms, one for each width that is refined.
///
/// With d widths x_1 … x_d (mesh width, time step, tolerance, …) the error is, to leading order,
/// Σ_i x_i^{p_i} A_i with fixed fields A_i, and a norm that comes from an inner product sees
///
///     e² = Σ_i T_i² + 2 Σ_{i<j} ρ_ij T_i T_j (+ T_f²),      T_i = a_i x_i^{p_i} (1 + c_i
///     g_i(x_i)),
///
/// where g_i is the next term of the series, x_i^{k_i}, or ln x_i where the term has a logarithm,
/// or x_i^{-p_i} where it has a constant, and T_f is a floor, which no width removes. Or all
/// of that saturates, e / (1 + s e): x − s x² + … of a sum x of leading terms has their products.
/// For d = 2 this is the model of two_term_model.hpp. It is fitted on ln e; x_i is in units of the
/// geometric mean of its values.
#pragma once

#include "studies/orders/least_squares.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// Scatter of ln e below this is rounding.
constexpr double least_scatter = 1e-7;

/// Rows as the regression wants them.
struct TermRows {
    Eigen::MatrixXd log_widths; ///< a row a record, a column a width
    Eigen::VectorXd log_errors;
    Eigen::VectorXd weights; ///< relative: 1 / variance of ln e
    double scatter = 0;      ///< known standard deviation of ln e at weight one; 0: not known
    bool rounded = false;    ///< scatter is that of rounding to the digits printed
    /// ln of the widths of a reference run that stands in for the exact solution: T_i is then its
    /// value at the row less that at the reference. NaN: exact in that width. Empty: in all.
    Eigen::VectorXd log_reference = {};
    /// The width in which squares are subtracted, T_i² = T_i(x)² − T_i(x_ref)²: of errors that
    /// oscillate in every element, as those of interpolation, the reference's own stands at right
    /// angles to the difference. -1: none, of errors that are smooth.
    Eigen::Index in_squares = -1;

    Eigen::Index size() const { return log_errors.size(); }
    Eigen::Index widths() const { return log_widths.cols(); }
    TermRows subset(const std::vector<Eigen::Index>& chosen) const;
    /// With one width alone.
    TermRows along(Eigen::Index width) const;
};

/// Which terms are there.
struct TermShape {
    static constexpr double none = -1;
    static constexpr double logarithm = 0;
    static constexpr double constant = -2;
    /// One a width: the power k > 0 of the next term, `logarithm`, `constant`, or `none`.
    std::vector<double> next;
    bool floor = false;
    bool saturates = false; ///< e / (1 + s e)

    int parameters() const;
    bool operator==(const TermShape&) const = default;
};

/// A number that a fit leads to, and its standard error.
struct FittedNumber {
    double value = 0;
    double error = 0; ///< infinite where the rows do not determine it
};

struct TermFit {
    TermShape shape;
    Eigen::VectorXd theta;      ///< (ln a_i, p_i)…, ρ_ij…, c_i…, ln T_f, s in these units
    Eigen::MatrixXd covariance; ///< of theta; infinite on its diagonal where it is not determined
    Eigen::MatrixXd root;       ///< covariance = root rootᵀ; empty where it is not determined
    Eigen::VectorXd log_centre; ///< ln of the unit of each width
    double log_unit = 0;        ///< ln of that of the errors, in which they are about one
    Eigen::VectorXd log_reference;
    Eigen::Index in_squares = -1; ///< TermRows::in_squares
    Eigen::VectorXd residuals;    ///< of every row of the window, ln e − ln model
    double scale = 0;             ///< sqrt(χ² / dof) of the robust fit
    double scatter = 0;           ///< TermRows::scatter
    int dof = 0;

    /// What makes 1.96 standard errors a 95 % interval: Student's quantile over the normal one,
    /// as far as the errors come from the residuals. Infinite without residuals and scatter.
    double student() const;

    FittedNumber order(Eigen::Index width) const;    ///< p_i
    FittedNumber log_size(Eigen::Index width) const; ///< ln of T_i / x^p_i where x → 0
    FittedNumber correlation(Eigen::Index first, Eigen::Index second) const; ///< ρ
    FittedNumber next(Eigen::Index width) const; ///< c_i; 0 without a next term
    /// c_i g_i there: the next term over the leading one; 0 without one, and for a constant.
    double next_part(Eigen::Index width, double log_width) const;
    /// T_i at a row, against the exact solution.
    double term(Eigen::Index width, double log_width) const;
    /// What a comparison with the reference shows of it.
    double measured_term(Eigen::Index width, double log_width) const;
    /// ln e at a row, against the exact solution or against the reference.
    FittedNumber log_error(const Eigen::VectorXd& log_widths, bool against_reference = false) const;
};

} // namespace tvbeam
