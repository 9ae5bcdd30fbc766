#include "studies/least_squares.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <cmath>
#include <limits>
#include <memory>

namespace tvbeam {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_iterations = 200;

/// Below this the columns of J are one to working precision, and (JᵀJ)⁻¹ has no correct digit.
constexpr double smallest_rcond = 1e-9;

struct Problem {
    const ModelFunction& model;
    const Eigen::VectorXd& y;
    Eigen::VectorXd theta;
    Eigen::VectorXd values;
    Eigen::MatrixXd jacobian;
};

void read(const gsl_vector* from, Eigen::VectorXd& to) {
    for (Eigen::Index i = 0; i < to.size(); ++i)
        to[i] = gsl_vector_get(from, static_cast<std::size_t>(i));
}

int residual_callback(const gsl_vector* theta, void* data, gsl_vector* out) {
    auto& problem = *static_cast<Problem*>(data);
    read(theta, problem.theta);
    problem.model(problem.theta, problem.values, nullptr);
    for (Eigen::Index i = 0; i < problem.y.size(); ++i)
        gsl_vector_set(out, static_cast<std::size_t>(i), problem.values[i] - problem.y[i]);
    return GSL_SUCCESS;
}

int jacobian_callback(const gsl_vector* theta, void* data, gsl_matrix* out) {
    auto& problem = *static_cast<Problem*>(data);
    read(theta, problem.theta);
    problem.model(problem.theta, problem.values, &problem.jacobian);
    for (Eigen::Index i = 0; i < problem.jacobian.rows(); ++i)
        for (Eigen::Index k = 0; k < problem.jacobian.cols(); ++k)
            gsl_matrix_set(out, static_cast<std::size_t>(i), static_cast<std::size_t>(k),
                           problem.jacobian(i, k));
    return GSL_SUCCESS;
}

using Workspace =
    std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)>;

Eigen::MatrixXd covariance(gsl_multifit_nlinear_workspace* workspace, Eigen::Index size, double s2,
                           int dof) {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
    double rcond = 0;
    gsl_multifit_nlinear_rcond(&rcond, workspace);
    if (dof < 1 || !(rcond > smallest_rcond)) {
        result.diagonal().setConstant(infinity);
        return result;
    }
    const auto n = static_cast<std::size_t>(size);
    const std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)> unscaled(gsl_matrix_alloc(n, n),
                                                                           gsl_matrix_free);
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(workspace), 0.0, unscaled.get());
    for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index k = 0; k < size; ++k)
            result(i, k) = s2 * gsl_matrix_get(unscaled.get(), static_cast<std::size_t>(i),
                                               static_cast<std::size_t>(k));
    return result;
}

} // namespace

double LeastSquares::scale() const {
    return dof > 0 ? std::sqrt(chi2 / dof) : 0.0;
}

double LeastSquares::standard_error(int k) const {
    return std::sqrt(covariance(k, k));
}

std::optional<LeastSquares> least_squares(const ModelFunction& model, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& weights,
                                          const Eigen::VectorXd& start) {
    const Eigen::Index observations = y.size();
    const Eigen::Index parameters = start.size();
    // GSL would end the process here.
    if (parameters < 1 || observations < parameters)
        return std::nullopt;

    Problem problem{model, y, start, Eigen::VectorXd(observations),
                    Eigen::MatrixXd(observations, parameters)};
    model(start, problem.values, nullptr);
    if (!problem.values.allFinite())
        return std::nullopt;

    gsl_multifit_nlinear_fdf functions{};
    functions.f = residual_callback;
    functions.df = jacobian_callback;
    functions.n = static_cast<std::size_t>(observations);
    functions.p = static_cast<std::size_t>(parameters);
    functions.params = &problem;

    auto options = gsl_multifit_nlinear_default_parameters();
    const Workspace workspace(
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &options, functions.n, functions.p),
        gsl_multifit_nlinear_free);
    const auto start_view = gsl_vector_const_view_array(start.data(), functions.p);
    const auto weight_view = gsl_vector_const_view_array(weights.data(), functions.n);
    gsl_multifit_nlinear_winit(&start_view.vector, &weight_view.vector, &functions,
                               workspace.get());
    // Where no step improves any more the driver reports a failure at the minimum itself (data
    // without noise do that), so its word is not asked: the caller compares what several starts
    // have reached.
    int why = 0;
    gsl_multifit_nlinear_driver(most_iterations, 1e-10, 1e-10, 0.0, nullptr, nullptr, &why,
                                workspace.get());

    LeastSquares result;
    result.theta.resize(parameters);
    read(gsl_multifit_nlinear_position(workspace.get()), result.theta);
    model(result.theta, problem.values, nullptr);
    result.residuals = y - problem.values;
    result.chi2 = weights.dot(result.residuals.cwiseAbs2());
    if (!result.theta.allFinite() || !std::isfinite(result.chi2))
        return std::nullopt;
    result.dof = static_cast<int>(observations - parameters);
    const double s = result.scale();
    result.covariance = covariance(workspace.get(), parameters, s * s, result.dof);
    return result;
}

double student_half_width(double se, int dof, double level) {
    if (dof < 1 || !std::isfinite(se))
        return infinity;
    return se * gsl_cdf_tdist_Pinv(0.5 * (1 + level), dof);
}

bool f_test_prefers_larger(double chi2_small, double chi2_large, int extra, int dof,
                           double significance) {
    if (extra < 1 || dof < 1 || !(chi2_large < chi2_small))
        return false;
    if (chi2_large <= 0)
        return true;
    const double ratio = ((chi2_small - chi2_large) / extra) / (chi2_large / dof);
    return gsl_cdf_fdist_Q(ratio, extra, dof) < significance;
}

} // namespace tvbeam
