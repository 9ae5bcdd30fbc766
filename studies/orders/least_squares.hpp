/// Weighted nonlinear least squares, with what an honest interval needs.
///
/// Minimises χ² = Σ_i w_i (y_i − f_i(θ))². The weights are relative: the variance of the data at
/// weight one is estimated from the residuals, s² = χ² / dof with dof = observations − parameters,
/// or known beforehand, where s² is no less than that; and
///
///     cov θ = s² (Jᵀ W J)⁻¹,      a 95 % interval is θ_k ± t_{0.975, dof} sqrt(cov_kk).
///
/// Without a degree of freedom and a known variance, or where J does not determine θ to working
/// precision, the covariance is infinite on its diagonal: an interval then covers everything, and
/// nothing passes by accident.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

/// What is not determined has an interval that covers everything.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sets the values f(θ), and the Jacobian ∂f_i/∂θ_k where it is not null. A NaN among the values
/// marks θ as inadmissible; the search turns back from there.
using ModelFunction = std::function<void(const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                                         Eigen::MatrixXd* jacobian)>;

struct LeastSquares {
    Eigen::VectorXd theta;
    Eigen::MatrixXd covariance;
    /// R with covariance = R Rᵀ: of a nearly singular fit that has digits which the product lost.
    /// Empty where θ is not determined.
    Eigen::MatrixXd root;
    Eigen::VectorXd residuals; ///< y − f(θ), not weighted
    double chi2 = 0;
    int dof = 0;

    /// sqrt(χ² / dof); 0 where dof is 0
    double scale() const;
    double standard_error(int k) const;
};

/// The best of what the starts lead to; all are of one length, of at most 12. None
/// where there are fewer observations than parameters, or no start is admissible. scatter: the
/// known standard deviation of y at weight one; 0 where it is not known. correlations: the places
/// of parameters that are no less than −1 and no greater than 1; at a bound that holds one back the
/// others have their least sum of squares.
std::optional<LeastSquares> least_squares(const ModelFunction& model, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& weights,
                                          std::span<const Eigen::VectorXd> starts,
                                          double scatter = 0,
                                          const std::vector<Eigen::Index>& correlations = {});

/// Student's quantile of 97.5 % over the normal one: what few degrees of freedom add to an
/// interval. Infinite where dof < 1.
double student_over_normal(int dof);

} // namespace tvbeam
