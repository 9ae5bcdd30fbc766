#include "studies/orders/least_squares.hpp"

#include "core/gsl_errors.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tvbeam {

namespace {

/// A search that has an end takes about ten. Where it has none (a term that is not there), more of
/// them only bend the model towards what is out of line.
constexpr int most_trials = 100;
constexpr double smallest_step = 1e-10;
constexpr double smallest_gradient = 1e-10;

constexpr int most_parameters = 12;

/// Below this the columns of J are one to working precision, and (JᵀJ)⁻¹ has no correct digit.
constexpr double smallest_rcond = 1e-9;

/// The model about one θ, and the sum of squares there: r = √w (f − y) and J = √w ∂f/∂θ.
struct Place {
    Eigen::VectorXd theta;
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;
    double chi2 = 0; ///< not finite where θ is inadmissible
};

/// R with R Rᵀ = s² (JᵀJ)⁻¹; empty where that is not determined.
Eigen::MatrixXd root_of_covariance(const Eigen::MatrixXd& jacobian, double s) {
    const Eigen::Index size = jacobian.cols();
    if (std::isinf(s))
        return {};
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian);
    const Eigen::MatrixXd r = qr.matrixR().topRows(size).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd inverse =
        r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(size, size));
    const auto norm = [](const Eigen::MatrixXd& matrix) {
        return matrix.cwiseAbs().colwise().sum().maxCoeff();
    };
    if (!(norm(r) * norm(inverse) * smallest_rcond < 1))
        return {};
    return s * (qr.colsPermutation() * inverse);
}

/// The search for the parameters. GSL has one, but the fits here are so small that most of its
/// time goes into algebra for matrices of any size.
class Search {
public:
    Search(const ModelFunction& model, const Eigen::VectorXd& y, const Eigen::VectorXd& weights,
           Eigen::Index size, double scatter, const std::vector<Eigen::Index>& correlations)
        : model_(model), y_(y), scatter_(scatter), correlations_(correlations),
          root_weights_(weights.cwiseSqrt()), here_{Eigen::VectorXd(size),
                                                    Eigen::VectorXd(y.size()),
                                                    Eigen::MatrixXd(y.size(), size), infinity},
          trial_(here_), best_(here_) {}

    /// Levenberg and Marquardt, with Moré's scaling of the parameters and Nielsen's damping (1999).
    /// Steps are cut off at the bounds of correlations, and one that would go on beyond its bound
    /// is held back while the others move. What it comes to is kept if it is the best so far.
    void descend_from(const Eigen::VectorXd& start) {
        here_.theta = start;
        evaluate(here_);
        if (!std::isfinite(here_.chi2))
            return;
        linearise();
        // Squares; a parameter that moves nothing yet has no scale of its own.
        Vector scales = (normal_.diagonal().array() > 0).select(normal_.diagonal(), 1.0);
        double damping = 1e-3;
        double next_rise = 2;
        for (int k = 0; k < most_trials && !joins_the_best(); ++k) {
            Matrix damped = normal_;
            damped.diagonal() += damping * scales;
            for (const auto place : held_back_) {
                damped.row(place).setZero();
                damped.col(place).setZero();
                damped(place, place) = 1;
            }
            Vector step = -damped.llt().solve(gradient_);
            if (!step.allFinite())
                break;
            trial_.theta = here_.theta + step;
            for (const auto place : correlations_)
                trial_.theta[place] = std::clamp(trial_.theta[place], -1.0, 1.0);
            step = trial_.theta - here_.theta;
            evaluate(trial_);
            const bool stands =
                (step.array().abs() <= smallest_step * (here_.theta.array().abs() + smallest_step))
                    .all();
            if (trial_.chi2 < here_.chi2) {
                // By the model that is linear about here_.
                const double promised = -step.dot(2 * gradient_ + normal_ * step);
                const double kept = 2 * (here_.chi2 - trial_.chi2) / promised - 1;
                if (promised > 0)
                    damping *= std::max(1.0 / 3, 1 - kept * kept * kept);
                next_rise = 2;
                std::swap(here_, trial_);
                linearise();
                scales = scales.cwiseMax(normal_.diagonal());
            } else {
                damping *= next_rise;
                next_rise *= 2;
            }
            if (stands || gradient_.lpNorm<Eigen::Infinity>() <=
                              smallest_gradient * std::max(1.0, here_.chi2 / 2))
                break;
        }
        // Of valleys that are equally deep the first start's, whatever rounding says.
        constexpr double deeper = 1 - 1e-9;
        if (here_.chi2 < deeper * best_.chi2)
            std::swap(here_, best_);
    }

    std::optional<LeastSquares> best() const {
        if (!std::isfinite(best_.chi2))
            return std::nullopt;
        LeastSquares result;
        result.theta = best_.theta;
        result.residuals = -best_.residuals.cwiseQuotient(root_weights_);
        result.chi2 = best_.chi2;
        result.dof = static_cast<int>(y_.size() - best_.theta.size());
        double s = std::max(result.scale(), scatter_);
        if (result.dof < 1 && !(scatter_ > 0))
            s = infinity;
        result.root = root_of_covariance(best_.jacobian, s);
        result.covariance = Eigen::MatrixXd::Zero(best_.theta.size(), best_.theta.size());
        if (result.root.size() > 0)
            result.covariance = result.root * result.root.transpose();
        else
            result.covariance.diagonal().setConstant(infinity);
        return result;
    }

private:
    // In place, without an allocation.
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_parameters, 1>;
    using Matrix =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_parameters, most_parameters>;

    void evaluate(Place& at) const {
        model_(at.theta, at.residuals, &at.jacobian);
        at.residuals = (at.residuals - y_).cwiseProduct(root_weights_);
        at.jacobian.array().colwise() *= root_weights_.array();
        at.chi2 = at.residuals.squaredNorm();
    }

    void linearise() {
        // Coefficient by coefficient: Eigen's blocked product is mostly overhead here.
        const auto& jacobian = here_.jacobian;
        normal_.resize(jacobian.cols(), jacobian.cols());
        gradient_.resize(jacobian.cols());
        for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
            for (Eigen::Index j = 0; j <= i; ++j)
                normal_(i, j) = normal_(j, i) = jacobian.col(j).dot(jacobian.col(i));
            gradient_[i] = jacobian.col(i).dot(here_.residuals);
        }
        held_back_.clear();
        for (const auto place : correlations_)
            if (std::abs(here_.theta[place]) >= 1 && gradient_[place] * here_.theta[place] <= 0) {
                held_back_.push_back(place);
                gradient_[place] = 0;
            }
    }

    /// A hundredth of a standard error from where an earlier start has ended, this one ends too.
    bool joins_the_best() const {
        if (!std::isfinite(best_.chi2))
            return false;
        constexpr double close = 1e-4;
        const Vector apart = here_.theta - best_.theta;
        return apart.dot(normal_ * apart) * static_cast<double>(y_.size()) <= close * best_.chi2;
    }

    const ModelFunction& model_;
    const Eigen::VectorXd& y_;
    double scatter_;
    const std::vector<Eigen::Index>& correlations_;
    std::vector<Eigen::Index> held_back_; ///< those at a bound that would go beyond it
    Eigen::VectorXd root_weights_;
    Place here_;
    Place trial_;
    Place best_;
    Matrix normal_;   ///< JᵀJ, here
    Vector gradient_; ///< Jᵀr, here; 0 of what is held back
};

} // namespace

double LeastSquares::scale() const {
    return dof > 0 ? std::sqrt(chi2 / dof) : 0.0;
}

double LeastSquares::standard_error(int k) const {
    return std::sqrt(covariance(k, k));
}

std::optional<LeastSquares> least_squares(const ModelFunction& model, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& weights,
                                          std::span<const Eigen::VectorXd> starts, double scatter,
                                          const std::vector<Eigen::Index>& correlations) {
    if (starts.empty() || y.size() < starts.front().size())
        return std::nullopt;
    if (starts.front().size() > most_parameters)
        throw std::invalid_argument("no model has so many parameters");
    Search search(model, y, weights, starts.front().size(), scatter, correlations);
    for (const auto& start : starts)
        search.descend_from(start);
    return search.best();
}

double student_over_normal(int dof) {
    return dof < 1 ? infinity : gsl_cdf_tdist_Pinv(0.975, dof) / gsl_cdf_ugaussian_Pinv(0.975);
}

} // namespace tvbeam
