#include "studies/orders/convergence_fit.hpp"

#include "studies/orders/least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace tvbeam {

namespace {

constexpr double floor_significance = 0.01;

/// Relative errors that agree to this are equal to rounding: no floor is read out of them.
constexpr double rounding = 1e-12;

struct Ladder {
    Eigen::VectorXd log_width;
    Eigen::VectorXd log_error;
    Eigen::VectorXd weights;
    std::vector<std::size_t> used;
    std::size_t distinct = 0;
    double log_centre = 0;
};

Ladder usable_part(std::span<const Refinement> records, std::span<const double> weights,
                   double Refinement::*width) {
    std::vector<double> x, y, w;
    Ladder ladder;
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (!is_positive(records[i].*width) || !is_positive(records[i].error))
            continue;
        ladder.used.push_back(i);
        x.push_back(std::log(records[i].*width));
        y.push_back(std::log(records[i].error));
        w.push_back(weights.empty() ? 1.0 : weights[i]);
    }
    const auto size = static_cast<Eigen::Index>(x.size());
    ladder.log_width = Eigen::Map<Eigen::VectorXd>(x.data(), size);
    ladder.log_error = Eigen::Map<Eigen::VectorXd>(y.data(), size);
    ladder.weights = Eigen::Map<Eigen::VectorXd>(w.data(), size);
    ladder.distinct = std::set<double>(x.begin(), x.end()).size();
    if (size > 0)
        ladder.log_centre = ladder.log_width.mean();
    return ladder;
}

/// θ = (ln C h_c^p, p[, ln floor]) with h_c the geometric mean of the widths: value and slope in
/// the middle of the ladder are hardly correlated, as ln C and p are.
ModelFunction model_of(const Ladder& ladder, std::optional<double> reference) {
    return [&ladder, reference](const Eigen::VectorXd& theta, Eigen::VectorXd& values,
                                Eigen::MatrixXd* jacobian) {
        const double p = theta[1];
        const double xr = reference ? std::log(*reference) - ladder.log_centre : 0.0;
        const double at_reference = reference ? std::exp(p * xr) : 0.0;
        const double floor = theta.size() > 2 ? std::exp(theta[2]) : 0.0;
        for (Eigen::Index i = 0; i < values.size(); ++i) {
            const double x = ladder.log_width[i] - ladder.log_centre;
            const double power = std::exp(p * x);
            const double term = std::exp(theta[0]) * (power - at_reference);
            values[i] = term > 0 ? std::log(term + floor) : std::nan("");
            if (jacobian == nullptr)
                continue;
            const double share = term / (term + floor);
            (*jacobian)(i, 0) = share;
            (*jacobian)(i, 1) = share * (power * x - at_reference * xr) / (power - at_reference);
            if (theta.size() > 2)
                (*jacobian)(i, 2) = 1 - share;
        }
    };
}

/// From the end points, which no pre-asymptotic wiggle in between can turn round.
double starting_order(const Ladder& ladder) {
    Eigen::Index finest = 0;
    Eigen::Index coarsest = 0;
    ladder.log_width.minCoeff(&finest);
    ladder.log_width.maxCoeff(&coarsest);
    return (ladder.log_error[coarsest] - ladder.log_error[finest]) /
           (ladder.log_width[coarsest] - ladder.log_width[finest]);
}

std::optional<LeastSquares> fit_without_floor(const Ladder& ladder,
                                              std::optional<double> reference) {
    const double level = ladder.log_error.mean();
    std::vector<Eigen::VectorXd> starts{Eigen::Vector2d(level, starting_order(ladder))};
    if (reference)
        for (const double p : {0.5, 1.0, 2.0, 4.0})
            starts.emplace_back(Eigen::Vector2d(level, p));
    return least_squares(model_of(ladder, reference), ladder.log_error, ladder.weights, starts);
}

std::optional<LeastSquares> fit_with_floor(const Ladder& ladder, std::optional<double> reference) {
    const double lowest = ladder.log_error.minCoeff();
    const double level = ladder.log_error.mean();
    std::vector<Eigen::VectorXd> starts;
    for (const double part : {0.95, 0.5, 0.1})
        for (const double order : {1.0, 1.5, 2.0, 4.0})
            starts.emplace_back(Eigen::Vector3d(level, order * std::abs(starting_order(ladder)),
                                                lowest + std::log(part)));
    return least_squares(model_of(ladder, reference), ladder.log_error, ladder.weights, starts);
}

double scatter_of_pairs(const Ladder& ladder, const PowerLawFit& fit) {
    std::vector<Refinement> terms;
    const double at_reference =
        fit.reference_width > 0 ? fit.c * std::pow(fit.reference_width, fit.p) : 0.0;
    for (Eigen::Index i = 0; i < ladder.log_width.size(); ++i)
        terms.push_back({.h = std::exp(ladder.log_width[i]),
                         .error = std::exp(ladder.log_error[i]) - fit.floor + at_reference});
    std::stable_sort(terms.begin(), terms.end(),
                     [](const auto& left, const auto& right) { return left.h > right.h; });
    // Records of the floor itself have nothing left, and no order.
    if (fit.floor > 0)
        std::erase_if(terms, [&](const auto& term) { return term.error < fit.floor; });
    double largest = 0;
    for (const auto& order : observed_orders(terms))
        if (order)
            largest = std::max(largest, std::abs(*order - fit.p));
    return largest;
}

/// (ln C h_c^p, p, …) back to (ln C, p, …)
PowerLawFit finish(const Ladder& ladder, const LeastSquares& fit, std::optional<double> reference) {
    Eigen::MatrixXd back = Eigen::MatrixXd::Identity(fit.theta.size(), fit.theta.size());
    back(0, 1) = -ladder.log_centre;
    PowerLawFit result;
    result.c = std::exp(fit.theta[0] - fit.theta[1] * ladder.log_centre);
    result.p = fit.theta[1];
    result.reference_width = reference.value_or(0.0);
    result.covariance = fit.covariance;
    if (fit.covariance.allFinite())
        result.covariance = back * fit.covariance * back.transpose();
    result.log_c_se = std::sqrt(result.covariance(0, 0));
    result.p_se = std::sqrt(result.covariance(1, 1));
    if (fit.theta.size() > 2) {
        result.floor = std::exp(fit.theta[2]);
        result.floor_se = result.floor * std::sqrt(result.covariance(2, 2));
    }
    result.dof = fit.dof;
    result.rms = fit.scale();
    result.p_half_width = student_half_width(result.p_se, fit.dof);
    result.p_scatter = scatter_of_pairs(ladder, result);
    result.used = ladder.used;
    return result;
}

void require_sound(std::span<const Refinement> records, const PowerLawOptions& options,
                   const Ladder& ladder) {
    if (options.reference_width && ladder.log_width.size() > 0 &&
        !(is_positive(*options.reference_width) &&
          std::log(*options.reference_width) < ladder.log_width.minCoeff()))
        throw std::invalid_argument("the reference must be finer than every record");
    if (!options.weights.empty() &&
        (options.weights.size() != records.size() ||
         !std::all_of(options.weights.begin(), options.weights.end(), is_positive)))
        throw std::invalid_argument("there must be one positive weight for each record");
}

} // namespace

double PowerLawFit::p_uncertainty() const {
    return std::max(p_half_width, p_scatter);
}

double PowerLawFit::error(double width) const {
    const double at_reference = reference_width > 0 ? std::pow(reference_width, p) : 0.0;
    return c * (std::pow(width, p) - at_reference) + floor;
}

std::optional<PowerLawFit> fit_power_law(std::span<const Refinement> records,
                                         const PowerLawOptions& options) {
    // Weights are checked before they are read.
    require_sound(records, options, {});
    Ladder ladder = usable_part(records, options.weights, &Refinement::h);
    if (ladder.distinct < 2)
        ladder = usable_part(records, options.weights, &Refinement::dt);
    require_sound(records, options, ladder);
    if (ladder.distinct < 2)
        return std::nullopt;

    const auto plain = fit_without_floor(ladder, options.reference_width);
    if (options.with_floor && (ladder.used.size() < 4 || ladder.distinct < 3))
        return std::nullopt;
    if (options.with_floor && !(plain && plain->scale() < rounding)) {
        const auto floored = fit_with_floor(ladder, options.reference_width);
        if (floored && (!plain || f_test_prefers_larger(plain->chi2, floored->chi2, 1, floored->dof,
                                                        floor_significance)))
            return finish(ladder, *floored, options.reference_width);
    }
    if (!plain)
        return std::nullopt;
    return finish(ladder, *plain, options.reference_width);
}

} // namespace tvbeam
