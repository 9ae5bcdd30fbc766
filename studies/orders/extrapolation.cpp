#include "studies/orders/extrapolation.hpp"

#include "core/gsl_errors.hpp"
#include "studies/orders/least_squares.hpp"

#include <gsl/gsl_roots.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tvbeam {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double factor_observed = 1.25;
constexpr double factor_assumed = 3.0;
/// An order beyond this is not one of a method; the search stops there.
constexpr double largest_order = 100;

void require_refinement(const GridValue& coarse, const GridValue& fine) {
    if (!(fine.h > 0 && coarse.h > fine.h && std::isfinite(coarse.h)))
        throw std::invalid_argument("h must be positive and fall from grid to grid");
}

struct Ratios {
    double log_fine;   ///< ln r_21
    double log_coarse; ///< ln r_32
    double log_quotient;
};

/// ln of (e^x − 1) / x, without its removable singularity and without overflow
double log_mean_growth(double x) {
    constexpr double tiny = 1e-8;
    constexpr double huge = 40;
    if (std::abs(x) < tiny)
        return x / 2;
    return x > huge ? x - std::log(x) : std::log(std::expm1(x) / x);
}

/// ln of right side over left side. (r_32^p − 1) / (1 − r_21^{−p}) has the same sign above and
/// below the line for every p ≠ 0, so that the logarithms exist.
double mismatch(double p, void* data) {
    const auto& ratios = *static_cast<const Ratios*>(data);
    return log_mean_growth(p * ratios.log_coarse) - log_mean_growth(-p * ratios.log_fine) +
           std::log(ratios.log_coarse / ratios.log_fine) - ratios.log_quotient;
}

Extrapolation extrapolate(const GridValue& coarse, const GridValue& fine, double order,
                          double factor) {
    Extrapolation result{.order = order};
    if (!(order > 0)) {
        result.limit = std::numeric_limits<double>::quiet_NaN();
        result.gci = infinite;
        return result;
    }
    const double gain = std::expm1(order * std::log(coarse.h / fine.h));
    result.limit = fine.value + (fine.value - coarse.value) / gain;
    result.gci = factor * std::abs(fine.value - coarse.value) / gain;
    return result;
}

} // namespace

std::optional<double> observed_order(const GridValue& coarse, const GridValue& medium,
                                     const GridValue& fine) {
    require_refinement(coarse, medium);
    require_refinement(medium, fine);
    const double quotient = (coarse.value - medium.value) / (medium.value - fine.value);
    if (!(quotient > 0) || !std::isfinite(quotient))
        return std::nullopt;
    Ratios ratios{std::log(medium.h / fine.h), std::log(coarse.h / medium.h), std::log(quotient)};

    gsl_function function{mismatch, &ratios};
    if (mismatch(-largest_order, &ratios) > 0 || mismatch(largest_order, &ratios) < 0)
        return std::nullopt;
    const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
        gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
    gsl_root_fsolver_set(solver.get(), &function, -largest_order, largest_order);
    constexpr int enough = 200;
    for (int k = 0; k < enough; ++k) {
        gsl_root_fsolver_iterate(solver.get());
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()),
                                   gsl_root_fsolver_x_upper(solver.get()), 1e-13,
                                   1e-13) == GSL_SUCCESS)
            break;
    }
    return gsl_root_fsolver_root(solver.get());
}

std::optional<Extrapolation> richardson(const GridValue& coarse, const GridValue& medium,
                                        const GridValue& fine) {
    const auto order = observed_order(coarse, medium, fine);
    if (!order)
        return std::nullopt;
    return extrapolate(medium, fine, *order, factor_observed);
}

Extrapolation richardson(const GridValue& coarse, const GridValue& fine, double assumed_order) {
    require_refinement(coarse, fine);
    if (!(assumed_order > 0))
        throw std::invalid_argument("the assumed order must be positive");
    return extrapolate(coarse, fine, assumed_order, factor_assumed);
}

double LimitFit::order_uncertainty() const {
    return std::max(order_half_width, order_scatter);
}

std::optional<LimitFit> fit_limit(std::span<const GridValue> grids) {
    std::vector<GridValue> sound;
    for (const auto& grid : grids)
        if (grid.h > 0 && std::isfinite(grid.h) && std::isfinite(grid.value))
            sound.push_back(grid);
    std::sort(sound.begin(), sound.end(),
              [](const auto& left, const auto& right) { return left.h > right.h; });
    std::size_t widths = sound.empty() ? 0 : 1;
    for (std::size_t i = 1; i < sound.size(); ++i)
        widths += sound[i].h < sound[i - 1].h ? 1 : 0;
    if (sound.size() < 4 || widths < 3)
        return std::nullopt;

    // In units of the sequence's own spread, h in units of the coarsest: θ = (f_0, C, p) are of
    // order one.
    const auto n = static_cast<Eigen::Index>(sound.size());
    const double unit_h = sound.front().h;
    const double origin = sound.back().value;
    double unit = 0;
    for (const auto& grid : sound)
        unit = std::max(unit, std::abs(grid.value - origin));
    if (unit == 0)
        return std::nullopt;
    Eigen::VectorXd log_h(n), y(n), weights(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto& grid = sound[static_cast<std::size_t>(i)];
        log_h[i] = std::log(grid.h / unit_h);
        y[i] = (grid.value - origin) / unit;
        weights[i] = unit_h / grid.h;
    }
    const ModelFunction model = [&](const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                                    Eigen::MatrixXd* jacobian) {
        const Eigen::VectorXd power = (theta[2] * log_h.array()).exp();
        values = theta[0] + (theta[1] * power.array());
        if (jacobian == nullptr)
            return;
        jacobian->col(0).setOnes();
        jacobian->col(1) = power;
        jacobian->col(2) = theta[1] * power.cwiseProduct(log_h);
    };
    std::vector<Eigen::VectorXd> starts;
    for (const double p : {0.5, 1.0, 2.0, 4.0})
        starts.emplace_back(Eigen::Vector3d(0.0, y[0], p));
    const auto best = least_squares(model, y, weights, starts);
    if (!best || !(best->theta[2] > 0))
        return std::nullopt;

    LimitFit result;
    result.limit = origin + unit * best->theta[0];
    result.limit_se = unit * best->standard_error(0);
    result.order = best->theta[2];
    result.order_se = best->standard_error(2);
    result.dof = best->dof;
    result.order_half_width = student_half_width(result.order_se, result.dof);
    for (std::size_t i = 2; i < sound.size(); ++i) {
        if (!(sound[i].h < sound[i - 1].h && sound[i - 1].h < sound[i - 2].h))
            continue;
        const auto order = observed_order(sound[i - 2], sound[i - 1], sound[i]);
        const double distance = order ? std::abs(*order - result.order) : infinite;
        result.order_scatter = std::max(result.order_scatter, distance);
    }
    result.uncertainty = factor_observed * std::abs(sound.back().value - result.limit) +
                         student_half_width(result.limit_se, result.dof);
    return result;
}

} // namespace tvbeam
