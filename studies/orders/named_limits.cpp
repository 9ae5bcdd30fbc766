#include "studies/orders/named_limits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

namespace {

/// ln of (e^x − 1) / x, without its removable singularity and without overflow.
double log_mean_growth(double x) {
    constexpr double tiny = 1e-8;
    constexpr double huge = 40;
    if (std::abs(x) < tiny)
        return x / 2;
    return x > huge ? x - std::log(x) : std::log(std::expm1(x) / x);
}

} // namespace

/// The signed order of three grids solves
///     (f_3 − f_2) / (f_2 − f_1) = r_21^p (r_32^p − 1) / (r_21^p − 1),
/// whose right side grows with p throughout.
std::optional<double> order_of_finest(std::span<const ValueRow> levels) {
    if (levels.size() < 3)
        return std::nullopt;
    const auto& fine = levels[levels.size() - 1];
    const auto& medium = levels[levels.size() - 2];
    const auto& coarse = levels[levels.size() - 3];
    const double log_fine = std::log(medium.h / fine.h);
    const double log_coarse = std::log(coarse.h / medium.h);
    const double quotient = (coarse.value - medium.value) / (medium.value - fine.value);
    if (!(quotient > 0) || !std::isfinite(quotient))
        return std::nullopt;
    double low = 0;
    double high = 100; // no method's order; the search stops there
    const auto exceeds = [&](double p) {
        return log_mean_growth(p * log_coarse) - log_mean_growth(-p * log_fine) +
                   std::log(log_coarse / log_fine) >
               std::log(quotient);
    };
    if (exceeds(low) || !exceeds(high))
        return std::nullopt;
    for (int k = 0; k < 60; ++k)
        (exceeds((low + high) / 2) ? high : low) = (low + high) / 2;
    return high;
}

/// Below this, steps stay the same but for rounding.
constexpr double no_order = 1e-3;

MethodAnswer silent(std::string why) {
    MethodAnswer none;
    none.silence = std::move(why);
    return none;
}

constexpr const char* wants_three = "it takes three levels";

MethodAnswer gci_of(std::span<const ValueRow> levels) {
    if (levels.size() < 3)
        return silent(wants_three);
    const auto order = order_of_finest(levels);
    if (!order)
        return silent("the three finest values oscillate, stand still or run apart");
    if (*order < no_order)
        return silent("the steps between the three finest values are all but the same");
    const auto& fine = levels[levels.size() - 1];
    const auto& medium = levels[levels.size() - 2];
    const double log_fine = std::log(medium.h / fine.h);
    const double step = medium.value - fine.value;
    const double gain = std::expm1(*order * log_fine);
    // Three grids whose order no common method has are not in the asymptotic range: the factor of
    // two grids, and no order above that (Oberkampf and Roy 2010, 8.6).
    constexpr double greatest_believed = 4;
    if (*order > 1.1 * greatest_believed)
        return MethodLimit{fine.value - step / gain,
                           3 * std::abs(step) / std::expm1(greatest_believed * log_fine), *order,
                           "f0 + C h^p; order above 4: factor 3, order 4 in the uncertainty"};
    constexpr double safety = 1.25; // of an order observed on three grids
    return MethodLimit{fine.value - step / gain, safety * std::abs(step) / gain, *order,
                       "f0 + C h^p"};
}

MethodAnswer celik_of(std::span<const ValueRow> levels) {
    if (levels.size() < 3)
        return silent(wants_three);
    const auto& fine = levels[levels.size() - 1];
    const auto& medium = levels[levels.size() - 2];
    const auto& coarse = levels[levels.size() - 3];
    const double r21 = medium.h / fine.h;
    const double r32 = coarse.h / medium.h;
    const double e21 = medium.value - fine.value;
    const double e32 = coarse.value - medium.value;
    if (e21 == 0 || e32 == 0)
        return silent("two of the three finest values are the same");
    const double sign = e32 / e21 < 0 ? -1 : 1;
    const auto signed_order = [&](double p) {
        return (std::log(std::abs(e32 / e21)) +
                std::log((std::pow(r21, p) - sign) / (std::pow(r32, p) - sign))) /
               std::log(r21);
    };
    const auto next = [&](double p) { return std::abs(signed_order(p)); };
    // The iteration of the procedure, and where that goes round in circles half its steps: what
    // solves the equation counts, not what an iteration ends with.
    const auto solved = [&](double part) -> std::optional<double> {
        double p = std::abs(std::log(std::abs(e32 / e21))) / std::log(r21);
        for (int k = 0; k < 400 && std::isfinite(p); ++k)
            p += part * (next(p) - p);
        const bool solves = p >= no_order && std::abs(next(p) - p) <= 1e-9 * std::max(1.0, p);
        return solves ? std::optional(p) : std::nullopt;
    };
    const auto whole = solved(1.0);
    const auto order = whole ? whole : solved(0.5);
    if (!order)
        return silent("its equation for the order has no solution above 0");
    const double p = *order;
    // The procedure takes an absolute value: of steps that grow it finds the order that those of
    // the opposite sequence have.
    if (signed_order(p) < 0)
        return silent("the steps between the three finest values grow");
    const double gain = std::expm1(p * std::log(r21));
    return MethodLimit{fine.value - e21 / gain, 1.25 * std::abs(e21) / gain, p,
                       sign < 0 ? "oscillatory" : "f0 + C h^p"};
}

namespace {

struct Candidate {
    LinearFit fit;
    double deviation = infinity;
    std::string model;
};

/// With one set of weights, of sum one: the power where its order is from ½ to 2, else the best of
/// the powers 1 and 2, and, where the order is less than ½, of both together.
std::optional<Candidate> eca_hoekstra_fit(std::span<const ValueRow> levels,
                                          const Eigen::VectorXd& weights) {
    const auto n = static_cast<double>(levels.size());
    const auto candidate = [&](const LimitModel& model,
                               const char* name) -> std::optional<Candidate> {
        const auto fit = fit_limit_model(levels, {weights}, model);
        if (!fit || fit->dof < 1)
            return std::nullopt;
        return Candidate{*fit, std::sqrt(fit->square * n / fit->dof), name};
    };
    auto best = candidate({std::nullopt}, "f0 + C h^p");
    const double order = best ? best->fit.order : 0;
    if (best && order >= 0.5 && order <= 2)
        return best;
    best = candidate({1.0}, "f0 + C h");
    const auto prefer = [&](const std::optional<Candidate>& other) {
        if (other && (!best || other->deviation < best->deviation))
            best = other;
    };
    prefer(candidate({2.0}, "f0 + C h^2"));
    if (order < 0.5)
        prefer(candidate({1.0, LimitModel::Next::one_more}, "f0 + C h + D h^2"));
    return best;
}

} // namespace

MethodAnswer eca_hoekstra_of(std::span<const ValueRow> levels) {
    const std::size_t n = levels.size();
    if (n < 4)
        return silent("it takes four levels");
    const Eigen::VectorXd equal =
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(n), 1.0 / static_cast<double>(n));
    Eigen::VectorXd by_width(equal.size());
    for (std::size_t i = 0; i < n; ++i)
        by_width[static_cast<Eigen::Index>(i)] = 1 / levels[i].h;
    by_width /= by_width.sum();
    auto best = eca_hoekstra_fit(levels, equal);
    const auto weighted = eca_hoekstra_fit(levels, by_width);
    if (weighted && (!best || weighted->deviation < best->deviation))
        best = weighted;
    if (!best)
        return silent("none of its models fits");
    const auto [low, high] =
        std::minmax_element(levels.begin(), levels.end(),
                            [](const auto& l, const auto& r) { return l.value < r.value; });
    const double range = (high->value - low->value) / static_cast<double>(n - 1);
    const double finest = levels.back().value;
    const double error = std::abs(best->fit.finest - best->fit.limit);
    const double rest = best->deviation + std::abs(finest - best->fit.finest);
    // Every order that is left is from ½ to 2, for which the factor of a good fit is 1.25.
    const double uncertainty = best->deviation < range
                                   ? 1.25 * error + rest
                                   : 3 * best->deviation / range * (error + rest);
    return MethodLimit{best->fit.limit, uncertainty, best->fit.order, best->model};
}

} // namespace tvbeam
