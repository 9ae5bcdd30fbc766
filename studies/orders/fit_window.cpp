#include "studies/orders/fit_window.hpp"

#include "core/gsl_errors.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

using Members = std::vector<Eigen::Index>;

/// Chance that a record which belongs to the model stops the growth, over all records together.
constexpr double false_alarm = 0.002;
/// A scatter of ln e below this is rounding, and departures of its size are no evidence of
/// anything.
constexpr double least_scatter = 1e-6;
/// A single record is out of line only where it stands off by several times this, however well the
/// others agree: a few per cent are a higher-order term, which bends a whole edge of the grid.
constexpr double least_blunder = 0.01;
constexpr int most_concentrations = 20;
/// Another half is preferred to the finest where it scatters less than a fifth as much.
constexpr double clearly_better = 0.04;

Members all_of(const TwoTermPoints& points) {
    Members members(static_cast<std::size_t>(points.size()));
    std::iota(members.begin(), members.end(), 0);
    return members;
}

/// √w |residual| of every point, infinite where the model has no value.
Eigen::VectorXd distances(const TwoTermPoints& points, const Eigen::VectorXd& theta) {
    Eigen::VectorXd values(points.size());
    two_term_values(points, theta, values, nullptr);
    Eigen::VectorXd result =
        (points.log_error - values).cwiseAbs().cwiseProduct(points.weights.cwiseSqrt());
    for (auto& distance : result)
        if (std::isnan(distance))
            distance = std::numeric_limits<double>::infinity();
    return result;
}

/// The `count` points with the smallest keys.
Members smallest(const Eigen::VectorXd& keys, std::size_t count) {
    Members order(static_cast<std::size_t>(keys.size()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index left, Eigen::Index right) {
        return keys[left] < keys[right];
    });
    order.resize(count);
    std::sort(order.begin(), order.end());
    return order;
}

/// Concentration steps: fit, take the half that is fitted best, until it stays the same.
std::optional<FitWindow> concentrated(const TwoTermPoints& points, Members half) {
    const auto size = half.size();
    auto fit = two_term_regression(points.subset(half));
    for (int step = 0; fit && step < most_concentrations; ++step) {
        auto next = smallest(distances(points, fit->theta), size);
        if (next == half)
            break;
        auto refit = two_term_regression(points.subset(next), fit->theta);
        if (!refit)
            break;
        half = std::move(next);
        fit = std::move(refit);
    }
    if (!fit)
        return std::nullopt;
    return FitWindow{.members = std::move(half), .fit = std::move(*fit)};
}

/// The half to begin with: the finest in both widths, in one, or another corner of the grid.
std::optional<FitWindow> first_half(const TwoTermPoints& points) {
    const auto n = static_cast<std::size_t>(points.size());
    const std::size_t size =
        std::max<std::size_t>(two_term_parameters + 2, (n + two_term_parameters + 1) / 2);
    const double spread_h = std::max(points.log_h.levels.cwiseAbs().maxCoeff(), 1e-300);
    const double spread_dt = std::max(points.log_dt.levels.cwiseAbs().maxCoeff(), 1e-300);
    const Eigen::VectorXd h = points.log_h.at_points() / spread_h;
    const Eigen::VectorXd dt = points.log_dt.at_points() / spread_dt;
    const std::vector<Eigen::VectorXd> corners{h + dt, h, dt, h - dt, dt - h, -h - dt};
    std::optional<FitWindow> best;
    for (const auto& coarseness : corners) {
        auto half = concentrated(points, smallest(coarseness, size));
        if (!half)
            continue;
        const double enough = static_cast<double>(size) * least_scatter * least_scatter;
        if (!best || half->fit.chi2 + enough < clearly_better * (best->fit.chi2 + enough))
            best = std::move(half);
    }
    return best;
}

/// Of the points outside, the one that is nearest to the fit in units of its prediction's standard
/// error.
struct Nearest {
    Eigen::Index point = -1;
    double t = std::numeric_limits<double>::infinity();
};

Nearest nearest_outside(const TwoTermPoints& points, const FitWindow& window) {
    Eigen::VectorXd values(points.size());
    Eigen::MatrixXd jacobian(points.size(), two_term_parameters);
    two_term_values(points, window.fit.theta, values, &jacobian);
    const double s = std::max(window.fit.scale(), least_blunder);
    const bool determined = window.fit.covariance.allFinite();
    const Eigen::VectorXd distance = distances(points, window.fit.theta);
    Nearest nearest;
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        if (std::binary_search(window.members.begin(), window.members.end(), i))
            continue;
        double variance = s * s;
        if (determined && jacobian.row(i).allFinite())
            variance += points.weights[i] *
                        jacobian.row(i).dot(window.fit.covariance * jacobian.row(i).transpose());
        const double t = distance[i] / std::sqrt(variance);
        if (nearest.point < 0 || t < nearest.t)
            nearest = {i, t};
    }
    return nearest;
}

/// How far p and q are from being known. Infinite where they are not determined.
double width_of_orders(const FitWindow& window) {
    const double variance = window.fit.covariance(1, 1) + window.fit.covariance(3, 3);
    return student_half_width(std::sqrt(variance), window.fit.dof);
}

std::optional<FitWindow> grown_window(const TwoTermPoints& points) {
    auto window = first_half(points);
    if (!window)
        return std::nullopt;
    const double level = false_alarm / static_cast<double>(points.size());
    std::optional<FitWindow> best;
    while (window->members.size() < static_cast<std::size_t>(points.size())) {
        const auto next = nearest_outside(points, *window);
        const double limit = gsl_cdf_tdist_Qinv(level / 2, window->fit.dof);
        // From the first alarm on every window is a candidate, and the most telling is kept.
        if ((best || next.t > limit) &&
            (!best || width_of_orders(*window) < width_of_orders(*best)))
            best = window;
        Members grown = window->members;
        grown.insert(std::upper_bound(grown.begin(), grown.end(), next.point), next.point);
        auto refit = two_term_regression(points.subset(grown), window->fit.theta);
        if (!refit)
            break;
        window = FitWindow{.members = std::move(grown), .fit = std::move(*refit)};
    }
    if (window->members.size() == static_cast<std::size_t>(points.size())) {
        // A warm start may have stayed in a valley of its own.
        const auto fresh = two_term_regression(points);
        if (fresh && fresh->chi2 < window->fit.chi2)
            window->fit = *fresh;
    }
    if (!best || width_of_orders(*window) < width_of_orders(*best))
        return window;
    return best;
}

/// The coarsest width of the members where more than enough are there to take it off.
std::optional<double> spare_level(const Members& members, const LogWidths& log_width) {
    std::set<double> widths;
    for (const auto i : members)
        widths.insert(log_width[i]);
    if (widths.size() <= fewest_levels)
        return std::nullopt;
    return *widths.rbegin();
}

/// The window without its coarsest h, its coarsest Δt, or both.
std::optional<FitWindow> without_edge(const TwoTermPoints& points, const FitWindow& window,
                                      bool in_h, bool in_dt) {
    const auto h = spare_level(window.members, points.log_h);
    const auto dt = spare_level(window.members, points.log_dt);
    if ((in_h && !h) || (in_dt && !dt))
        return std::nullopt;
    Members finer;
    for (const auto i : window.members)
        if (!(in_h && points.log_h[i] == *h) && !(in_dt && points.log_dt[i] == *dt))
            finer.push_back(i);
    if (finer.size() < two_term_parameters + 2)
        return std::nullopt;
    auto fit = two_term_regression(points.subset(finer), window.fit.theta);
    if (!fit)
        return std::nullopt;
    return FitWindow{.members = std::move(finer), .fit = std::move(*fit)};
}

/// Higher-order terms bend a whole coarse edge a little, and no single record of it stands out. The
/// edge is taken off where it is not consistent with what is finer (F test) and the orders are
/// better known without it.
FitWindow trimmed_window(const TwoTermPoints& points, FitWindow window) {
    while (window.fit.scale() > least_scatter) {
        std::optional<FitWindow> best;
        for (const auto& [in_h, in_dt] : {std::pair{true, false}, {false, true}, {true, true}}) {
            auto finer = without_edge(points, window, in_h, in_dt);
            if (!finer)
                continue;
            const auto dropped = static_cast<int>(window.members.size() - finer->members.size());
            if (f_test_prefers_larger(window.fit.chi2, finer->fit.chi2, dropped, finer->fit.dof,
                                      false_alarm) &&
                width_of_orders(*finer) < width_of_orders(best ? *best : window))
                best = std::move(finer);
        }
        if (!best)
            break;
        window = std::move(*best);
    }
    return window;
}

/// What the next terms say of the bias of p and q, where the data ask for next terms (F test). They
/// are sought in the window before its edges were taken off, for there they show: one or two powers
/// further, as in a Taylor series with all terms or with every other.
void seek_next_terms(const TwoTermPoints& points, const FitWindow& grown, FitWindow& window) {
    if (grown.fit.scale() < least_scatter)
        return;
    auto part = points.subset(grown.members);
    std::optional<LeastSquares> longer;
    for (const double in_h : {1.0, 2.0})
        for (const double in_dt : {1.0, 2.0}) {
            part.next_terms = {in_h, in_dt};
            auto fit = two_term_regression(part, window.fit.theta);
            if (fit && (!longer || fit->chi2 < longer->chi2))
                longer = std::move(fit);
        }
    if (!longer || !f_test_prefers_larger(grown.fit.chi2, longer->chi2, next_term_parameters,
                                          longer->dof, false_alarm))
        return;
    window.p_with_next = longer->theta[1];
    window.q_with_next = longer->theta[3];
}

} // namespace

std::optional<FitWindow> whole_window(const TwoTermPoints& points) {
    auto fit = two_term_regression(points);
    if (!fit)
        return std::nullopt;
    return FitWindow{.members = all_of(points), .fit = std::move(*fit)};
}

std::optional<FitWindow> forward_window(const TwoTermPoints& points) {
    const auto grown = grown_window(points);
    if (!grown)
        return std::nullopt;
    auto window = trimmed_window(points, *grown);
    seek_next_terms(points, *grown, window);
    return window;
}

} // namespace tvbeam
