#include "studies/orders/two_term_fit.hpp"

#include "studies/orders/convergence_fit.hpp"
#include "studies/orders/fit_window.hpp"
#include "studies/orders/two_term_regression.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

constexpr std::size_t fewest_records = two_term_parameters + 2;
constexpr double second_term_significance = 0.01;
/// cos φ below which ρ counts as ±1: 1 − |ρ| < 5e-7.
constexpr double at_the_bound = 1e-3;

std::string with_number(const char* format, double number) {
    char text[160];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

/// The records that have a logarithm; the others are rejected.
std::vector<std::size_t> usable(std::span<const Refinement> records,
                                std::vector<RejectedRecord>& rejected) {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto& record = records[i];
        if (!is_positive(record.h) || !is_positive(record.dt))
            rejected.push_back(
                {i, Rejection::failed, "no error: h or dt is missing or not positive"});
        else if (record.error == 0)
            rejected.push_back({i, Rejection::exact, "the error is zero and has no logarithm"});
        else if (!is_positive(record.error))
            rejected.push_back({i, Rejection::failed, "no error: it is not a positive number"});
        else if (!record.is_resolved())
            rejected.push_back(
                {i, Rejection::unresolved,
                 with_number("the error is uncertain by %.1e of itself", record.uncertainty)});
        else
            result.push_back(i);
    }
    return result;
}

template <class Value>
std::size_t levels(std::span<const Refinement> records, const std::vector<std::size_t>& chosen,
                   Value value) {
    std::set<double> distinct;
    for (const auto i : chosen)
        distinct.insert(records[i].*value);
    return distinct.size();
}

TwoTermPoints points_of(std::span<const Refinement> records, const std::vector<std::size_t>& chosen,
                        const TwoTermOptions& options) {
    const auto n = static_cast<Eigen::Index>(chosen.size());
    Eigen::VectorXd log_h(n);
    Eigen::VectorXd log_dt(n);
    Eigen::VectorXd log_error(n);
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const auto i = chosen[static_cast<std::size_t>(k)];
        log_h[k] = std::log(records[i].h);
        log_dt[k] = std::log(records[i].dt);
        log_error[k] = std::log(records[i].error);
        if (!options.weights.empty())
            weights[k] = options.weights[i];
    }
    // Relative weights: their mean is one, so that χ² / dof is the scatter of ln e itself.
    weights /= weights.mean();
    const double log_h_centre = log_h.mean();
    const double log_dt_centre = log_dt.mean();
    TwoTermPoints points{.log_h = LogWidths::of(log_h.array() - log_h_centre),
                         .log_dt = LogWidths::of(log_dt.array() - log_dt_centre),
                         .log_error = std::move(log_error),
                         .weights = std::move(weights),
                         .log_h_centre = log_h_centre,
                         .log_dt_centre = log_dt_centre};
    if (options.reference && !std::isnan(options.reference->h))
        points.reference_log_h = std::log(options.reference->h) - points.log_h_centre;
    if (options.reference && !std::isnan(options.reference->dt))
        points.reference_log_dt = std::log(options.reference->dt) - points.log_dt_centre;
    return points;
}

void require_sound(std::span<const Refinement> records, const TwoTermOptions& options) {
    if (!options.weights.empty() &&
        (options.weights.size() != records.size() ||
         !std::all_of(options.weights.begin(), options.weights.end(), is_positive)))
        throw std::invalid_argument("there must be one positive weight for each record");
    if (!options.reference)
        return;
    for (const auto& record : records)
        if (options.reference->h > record.h || options.reference->dt > record.dt ||
            options.reference->h <= 0 || options.reference->dt <= 0)
            throw std::invalid_argument("the reference must be as fine as every record");
}

/// χ² of the records used about a power law in one width alone.
std::optional<PowerLawFit> single_term(std::span<const Refinement> records, const TwoTermFit& fit,
                                       const TwoTermOptions& options, double Refinement::*width) {
    std::vector<Refinement> alone;
    std::vector<double> weights;
    for (const auto i : fit.used) {
        Refinement record{.error = records[i].error};
        record.*width = records[i].*width;
        alone.push_back(record);
        weights.push_back(options.weights.empty() ? 1.0 : options.weights[i]);
    }
    PowerLawOptions law{.weights = weights};
    if (options.reference && is_positive((*options.reference).*width))
        law.reference_width = (*options.reference).*width;
    try {
        return fit_power_law(alone, law);
    } catch (const std::invalid_argument&) {
        return std::nullopt; // the reference shares its width with a record: no such law
    }
}

/// Keep the second term only where the data ask for it.
void prefer_single_term(std::span<const Refinement> records, const TwoTermOptions& options,
                        TwoTermFit& fit) {
    const double chi2 = fit.rms * fit.rms * fit.dof;
    constexpr int more = two_term_parameters - 2;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const bool in_space : {true, false}) {
        const auto law =
            single_term(records, fit, options, in_space ? &Refinement::h : &Refinement::dt);
        if (!law || f_test_prefers_larger(law->rms * law->rms * law->dof, chi2, more, fit.dof,
                                          second_term_significance))
            continue;
        fit.covariance = Eigen::VectorXd::Constant(two_term_parameters, infinity).asDiagonal();
        fit.covariance.block<2, 2>(in_space ? 0 : 2, in_space ? 0 : 2) = law->covariance;
        fit.model = in_space ? TwoTermModel{.a = law->c, .p = law->p, .b = 0, .q = none}
                             : TwoTermModel{.a = 0, .p = none, .b = law->c, .q = law->p};
        fit.dof = law->dof;
        fit.rms = law->rms;
        return;
    }
}

void set_errors(TwoTermFit& fit) {
    fit.log_a_se = std::sqrt(fit.covariance(0, 0));
    fit.p_se = std::sqrt(fit.covariance(1, 1));
    fit.log_b_se = std::sqrt(fit.covariance(2, 2));
    fit.q_se = std::sqrt(fit.covariance(3, 3));
    fit.rho_se = std::sqrt(fit.covariance(4, 4));
    fit.p_half_width = student_half_width(fit.p_se, fit.dof);
    fit.q_half_width = student_half_width(fit.q_se, fit.dof);
}

double drift(double size, double order, const std::optional<double>& with_next) {
    return size > 0 && with_next ? std::abs(order - *with_next) : 0.0;
}

double modelled(const TwoTermFit& fit, const TwoTermOptions& options, const Refinement& record) {
    return error_against(options.reference.value_or(Refinement{}), fit.model, record.h, record.dt);
}

/// Errors within this of each other are one.
constexpr double error_stays = 1.1;

/// Does refinement that the model answers to leave the error where it was? Seen against any record
/// that is coarser.
bool stays(std::span<const Refinement> records, const TwoTermFit& fit,
           const TwoTermOptions& options, const Refinement& record) {
    constexpr double model_shrinks = 2.0;
    return std::any_of(records.begin(), records.end(), [&](const Refinement& coarser) {
        return is_positive(coarser.error) && coarser.h >= record.h && coarser.dt >= record.dt &&
               modelled(fit, options, coarser) >= model_shrinks * modelled(fit, options, record) &&
               coarser.error <= error_stays * record.error;
    });
}

/// At the height of a record whose error stays.
bool is_at_floor(std::span<const Refinement> records, const TwoTermFit& fit,
                 const TwoTermOptions& options, const Refinement& record) {
    return std::any_of(records.begin(), records.end(), [&](const Refinement& other) {
        return is_positive(other.error) && other.error <= error_stays * record.error &&
               record.error <= error_stays * other.error && stays(records, fit, options, other);
    });
}

RejectedRecord explain(std::span<const Refinement> records, const TwoTermFit& fit,
                       const TwoTermOptions& options, std::size_t i) {
    double least = std::numeric_limits<double>::infinity();
    double coarsest_h = 0;
    double coarsest_dt = 0;
    for (const auto k : fit.used) {
        least = std::min(least, modelled(fit, options, records[k]));
        coarsest_h = std::max(coarsest_h, records[k].h);
        coarsest_dt = std::max(coarsest_dt, records[k].dt);
    }
    const auto& record = records[i];
    const double predicted = modelled(fit, options, record);
    const double factor = record.error / predicted;
    // Where the model is smallest: below all that it was fitted to, or nearly.
    constexpr double nearly = 1.5;
    const bool above_least = factor > 1 && predicted <= nearly * least;
    Rejection why = Rejection::outlier;
    if (above_least && is_at_floor(records, fit, options, record))
        why = Rejection::floor;
    else if (record.h >= coarsest_h || record.dt >= coarsest_dt)
        why = Rejection::pre_asymptotic;
    else if (above_least)
        why = Rejection::too_fine;
    return {i, why, words_for(why) + with_number(": the error is %.4g times the model's", factor)};
}

/// ln e − ln model for every record, against the reference where there is one.
std::vector<double> residuals_of(std::span<const Refinement> records, const TwoTermModel& model,
                                 const TwoTermOptions& options) {
    std::vector<double> residuals;
    for (const auto& record : records) {
        const double of_model =
            error_against(options.reference.value_or(Refinement{}), model, record.h, record.dt);
        residuals.push_back(std::log(record.error) - std::log(of_model));
        if (!std::isfinite(residuals.back()))
            residuals.back() = std::numeric_limits<double>::quiet_NaN();
    }
    return residuals;
}

/// Range of ln e of the model over the used records that share the other width, where it is widest.
double change_by(double Refinement::*width, std::span<const Refinement> records,
                 const TwoTermFit& fit, const TwoTermOptions& options) {
    const auto other = width == &Refinement::h ? &Refinement::dt : &Refinement::h;
    std::map<double, std::pair<double, double>> ranges;
    double widest = 0;
    for (const auto i : fit.used) {
        const double log_error = std::log(error_against(options.reference.value_or(Refinement{}),
                                                        fit.model, records[i].h, records[i].dt));
        auto& range = ranges.try_emplace(records[i].*other, log_error, log_error).first->second;
        range.first = std::min(range.first, log_error);
        range.second = std::max(range.second, log_error);
        widest = std::max(widest, range.second - range.first);
    }
    return widest;
}

void set_influence(std::span<const Refinement> records, const TwoTermOptions& options,
                   TwoTermFit& fit) {
    fit.change_by_h = change_by(&Refinement::h, records, fit, options);
    fit.change_by_dt = change_by(&Refinement::dt, records, fit, options);
    for (const auto i : fit.used) {
        const double h = records[i].h;
        const double dt = records[i].dt;
        const double error = fit.model.error(h, dt);
        fit.share_of_h = std::max(fit.share_of_h, fit.model.spatial(h) / error);
        fit.share_of_dt = std::max(fit.share_of_dt, fit.model.temporal(dt) / error);
    }
}

struct Influence {
    double change = 0;
    double share = 0;
};

bool determined(double order, double uncertainty, double rms, const Influence& own,
                const Influence& other) {
    const double moved = TwoTermFit::least_change * std::max(rms, TwoTermFit::least_scatter);
    return order > 0 && uncertainty <= TwoTermFit::widest_uncertainty && own.change > moved &&
           (other.change > moved || other.share <= TwoTermFit::harmless_share);
}

} // namespace

const char* words_for(Rejection why) {
    switch (why) {
    case Rejection::failed:
        return "no error";
    case Rejection::unresolved:
        return "quadrature does not resolve what is integrated";
    case Rejection::exact:
        return "the error is zero";
    case Rejection::floor:
        return "at a floor, where refinement takes nothing from the error";
    case Rejection::pre_asymptotic:
        return "too coarse for the model";
    case Rejection::too_fine:
        return "too fine for the model, which coarser runs gave: the error shrinks more slowly";
    case Rejection::outlier:
        break;
    }
    return "out of line with their neighbours";
}

bool TwoTermFit::p_determined() const {
    return determined(model.p, p_uncertainty(), rms, {change_by_h, share_of_h},
                      {change_by_dt, share_of_dt});
}

bool TwoTermFit::q_determined() const {
    return determined(model.q, q_uncertainty(), rms, {change_by_dt, share_of_dt},
                      {change_by_h, share_of_h});
}

TwoTermFit fit_two_term(std::span<const Refinement> records, const TwoTermOptions& options) {
    require_sound(records, options);
    TwoTermFit fit;
    fit.residuals.assign(records.size(), std::numeric_limits<double>::quiet_NaN());
    const auto chosen = usable(records, fit.rejected);
    if (chosen.size() < fewest_records || levels(records, chosen, &Refinement::h) < fewest_levels ||
        levels(records, chosen, &Refinement::dt) < fewest_levels) {
        fit.failure = "the two-term model needs seven finite, positive errors in three h and "
                      "three dt";
        return fit;
    }

    auto points = points_of(records, chosen, options);
    const auto window = options.all_records ? whole_window(points) : forward_window(points);
    if (!window) {
        fit.failure = "the search for the two-term model came to no end";
        return fit;
    }
    auto best = window->fit;
    if (std::abs(std::cos(best.theta[4])) < at_the_bound) {
        points.fixed_rho = std::sin(best.theta[4]) < 0 ? -1.0 : 1.0;
        if (auto held = two_term_regression(points.subset(window->members), best.theta))
            best = std::move(*held);
        else
            points.fixed_rho.reset();
    }

    fit.model = two_term_model(points, best.theta);
    fit.covariance = two_term_covariance(points, best);
    fit.dof = best.dof;
    fit.rms = best.scale();
    for (const auto k : window->members)
        fit.used.push_back(chosen[static_cast<std::size_t>(k)]);
    prefer_single_term(records, options, fit);
    // Of the model that is handed out, which need not be the window's: ρ may be held by now, or a
    // term be gone. A term that is gone has no order, and no bias of one.
    fit.p_drift = drift(fit.model.a, fit.model.p, window->p_with_next);
    fit.q_drift = drift(fit.model.b, fit.model.q, window->q_with_next);
    set_errors(fit);
    set_influence(records, options, fit);
    fit.residuals = residuals_of(records, fit.model, options);
    for (const auto i : chosen)
        if (!std::binary_search(fit.used.begin(), fit.used.end(), i))
            fit.rejected.push_back(explain(records, fit, options, i));
    std::sort(fit.rejected.begin(), fit.rejected.end(),
              [](const auto& left, const auto& right) { return left.record < right.record; });
    return fit;
}

} // namespace tvbeam
