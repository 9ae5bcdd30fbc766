#include "studies/orders/limit_engine.hpp"

#include "studies/orders/observed_order.hpp"
#include "studies/orders/value_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

using Next = LimitModel::Next;
const LimitModel limit_models[] = {{std::nullopt},
                                   {1.0},
                                   {2.0},
                                   {1.0, Next::one_more},
                                   {std::nullopt, Next::one_more},
                                   {std::nullopt, Next::doubled},
                                   {std::nullopt, Next::none, true},
                                   {std::nullopt, Next::none, false, 1},
                                   {std::nullopt, Next::none, false, 2}};

Weights weights_of(std::span<const ValueRow> rows) {
    Eigen::VectorXd weights(static_cast<Eigen::Index>(rows.size()));
    for (Eigen::Index i = 0; i < weights.size(); ++i) {
        const double sigma = rows[static_cast<std::size_t>(i)].sigma;
        if (!is_positive(sigma))
            return {Eigen::VectorXd::Ones(weights.size())};
        weights[i] = 1 / (sigma * sigma);
    }
    return {weights / weights.mean(), 1 / std::sqrt(weights.mean())};
}

struct Weighed {
    double value = 0;
    double unit = 0;
};

struct Mean {
    double value = 0;
    double spread = 0;
};

std::optional<Mean> mean_of(const std::vector<Weighed>& all, double agreement) {
    double weights = 0, mean = 0, square = 0;
    if (all.empty())
        return std::nullopt;
    const double origin = all.front().value;
    for (const auto& one : all) {
        const double weight = 1 / std::pow(one.unit + agreement, 2);
        weights += weight;
        mean += weight * (one.value - origin);
        square += weight * (std::pow(one.value - origin, 2) + one.unit * one.unit);
    }
    mean /= weights;
    return Mean{origin + mean, std::sqrt(std::max(0.0, square / weights - mean * mean))};
}

double finest_step(const ValueLevels& levels) {
    return std::abs(levels[levels.size() - 2].value - levels.back().value);
}

/// All windows that end at the finest level, each compared with the one a level coarser.
void weigh(const ValueLevels& levels, const LimitModel& model, std::vector<Weighed>& limits,
           std::vector<double>& orders) {
    const std::size_t n = levels.size();
    for (std::size_t length = static_cast<std::size_t>(model.parameters()); length <= n; ++length) {
        const std::span<const ValueRow> window(levels.data() + (n - length), length);
        const auto fit = fit_limit_model(window, weights_of(window), model);
        if (!fit)
            continue;
        double change = 0;
        bool compared = false;
        // The same length one level coarser; where there is none, its rows but for the finest.
        const std::size_t shorter = length < n ? length : length - 1;
        const std::span<const ValueRow> before(levels.data() + (n - 1 - shorter), shorter);
        if (const auto coarser = fit_limit_model(before, weights_of(before), model)) {
            const double ratio = levels[n - 2].h / levels[n - 1].h;
            // A limit with the wrong order goes on like h^½ at worst, one with the right order p
            // like the next term: h^p more, as of powers of one width, where p is below 1.
            const double rate =
                model.order ? std::sqrt(ratio) : std::pow(ratio, std::min(fit->order, 1.0));
            change = std::abs(coarser->limit - fit->limit) / (rate - 1);
            compared = true;
        }
        if (!compared || !std::isfinite(fit->limit_error))
            continue;
        // On four levels it is chance that a model of three numbers stays where it is.
        constexpr std::size_t few = 4;
        const double back = n > few ? 0.0 : fit->goes_back;
        limits.push_back({fit->limit, std::hypot(change, fit->limit_error, back)});
        if (!model.order)
            orders.push_back(fit->order);
    }
}

/// The deviation that the best of the models leaves, with Student's factor. Three levels do not
/// show any.
double scatter_of(const ValueLevels& levels) {
    double least = levels.size() > 3 ? infinity : 0.0;
    for (const auto& model : limit_models) {
        const int dof = static_cast<int>(levels.size()) - model.parameters();
        if (dof < 1)
            continue;
        if (const auto fit = fit_limit_model(levels, weights_of(levels), model))
            least = std::min(least, std::sqrt(fit->square / dof) * student_over_normal(dof));
    }
    return least;
}

/// Whether what is known of a value's deviation is that its digits are few.
bool is_rounding(const ValueRow& level) {
    return level.sigma < level.unit;
}

/// The order of the differences between consecutive levels, as the engine of orders sees that of
/// errors. Of f_0 + C h^p + D h^{p+1} they are, over (h_k^p − h_{k+1}^p) / H_k^p with the widths
///
///     H_k = (h_k^{p+1} − h_{k+1}^{p+1}) / (h_k^p − h_{k+1}^p),
///
/// C H_k^p + D H_k^{p+1}, whatever the ratios of the widths. p is the order found before;
/// from_models: the first.
OrderInterval order_of_differences(const ValueLevels& given, double from_models) {
    OrderInterval order;
    const ValueLevels levels = past_the_turn(given);
    double p = from_models;
    double least = infinity, greatest = 0;
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
        least = std::min(least, levels[k].h / levels[k + 1].h);
        greatest = std::max(greatest, levels[k].h / levels[k + 1].h);
    }
    // Of one ratio, the factor is a constant whatever the order.
    constexpr double same = 1 + 1e-6;
    const int rounds = greatest <= same * least ? 1 : 4;
    for (int round = 0; round < rounds; ++round) {
        std::vector<ErrorRow> differences;
        for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
            const double step = std::abs(levels[k].value - levels[k + 1].value);
            const double log_ratio = std::log(levels[k].h / levels[k + 1].h);
            const double leading = -std::expm1(-p * log_ratio);
            const double stretch = -std::expm1(-(p + 1) * log_ratio) / leading;
            differences.push_back({{levels[k].h * stretch},
                                   step * std::pow(stretch, p) / leading,
                                   std::hypot(levels[k].sigma, levels[k + 1].sigma) / step,
                                   is_rounding(levels[k]) && is_rounding(levels[k + 1])});
        }
        // Those of values that go to and fro leave residuals that are no scatter.
        order = estimate_orders(differences, {},
                                {.contradicted = infinity,
                                 .log_finest = std::log(levels.back().h),
                                 .of_steps = true})
                    .front();
        if (!(order.value > 0))
            break;
        p = order.value;
    }
    return order;
}

ValueLevels with_scatter(ValueLevels levels, double scatter) {
    for (auto& level : levels)
        if (std::isnan(level.sigma))
            level.sigma = scatter;
    return levels;
}

/// What both say; the first that is not determined, if one is not.
OrderInterval hull(const OrderInterval& one, const OrderInterval& other) {
    if (!one.determined || !other.determined)
        return one.determined ? other : one;
    OrderInterval both = one;
    both.low = std::min(one.low, other.low);
    both.high = std::max(one.high, other.high);
    both.value = std::midpoint(both.low, both.high);
    return both;
}

/// What the fits of all models to all windows say, of values over their scale.
struct LimitFits {
    std::vector<Weighed> limits;          ///< by models in powers of h
    std::vector<Weighed> with_logarithms; ///< … and in ln h, where these may be meant
    double order = 1;                     ///< of the models in powers, the median
    double scatter = 0;
    bool is_scattered = false;
};

LimitFits fit_all(const ValueLevels& levels, const LimitTuning& tuning) {
    LimitFits fits;
    std::vector<double> orders;
    const auto weigh_all = [&](bool logarithmic, std::vector<Weighed>& limits) {
        for (const auto& model : limit_models)
            if ((model.logarithmic > 0) == logarithmic &&
                (!model.alternating || alternates(levels)))
                weigh(levels, model, limits, orders);
    };
    weigh_all(false, fits.limits);
    std::sort(orders.begin(), orders.end());
    if (!orders.empty())
        fits.order = orders[orders.size() / 2];
    fits.scatter = scatter_of(levels);
    fits.is_scattered = finest_step(levels) < tuning.exact_steps * fits.scatter;
    fits.with_logarithms = fits.limits;
    // Where values scatter every low order follows them, and every logarithm.
    if (!fits.is_scattered && fits.order < tuning.logarithmic_below)
        weigh_all(true, fits.with_logarithms);
    return fits;
}

/// The mean of the limits and an interval of their spread, at the scale of the values as given.
void set_limit(LimitEstimate& result, const LimitFits& fits, const ScaledLevels& of,
               const LimitTuning& tuning) {
    const auto spare = static_cast<double>(of.levels.size()) - 2;
    const bool is_wider = fits.is_scattered && is_erratic(of.levels);
    const double factor =
        (is_wider ? tuning.scattered : tuning.factor) * (1 + tuning.few_levels / (spare * spare));
    // What the doubles of the values do not know, in units of the scale.
    const double unknown = roundings * std::numeric_limits<double>::epsilon() *
                           std::max(std::abs(of.origin) / of.scale, 1.0);
    const double agreement = tuning.agreement * finest_step(of.levels) + unknown;
    const auto mean = mean_of(fits.limits, agreement);
    if (!mean) {
        result.limit.status = "no model fits";
        return;
    }
    const auto half_of = [&](const Mean& other) {
        return std::abs(other.value - mean->value) + factor * other.spread +
               tuning.narrowest * std::abs(other.value) + unknown;
    };
    const double half = std::max(
        of.scale * std::max(half_of(*mean), half_of(*mean_of(fits.with_logarithms, agreement))),
        std::max(of.scale * of.levels.back().unit / 2, is_wider ? of.scale * fits.scatter : 0.0));
    const double limit = of.origin + of.scale * mean->value;
    if (!std::isfinite(limit) || !std::isfinite(half)) {
        result.limit.status = "values or deviations of so many sizes overflow";
        return;
    }
    result.limit = {limit, limit - half, limit + half, true, 1, ""};
    result.uncertainty = of.scale * std::abs(mean->value) + half;
    result.basis = std::to_string(of.levels.size()) + " levels, " +
                   std::to_string(fits.limits.size()) + " fits";
}

OrderInterval order_of(const ValueLevels& levels, const LimitFits& fits) {
    OrderInterval order = order_of_differences(levels, fits.order);
    // Of scatter that is not stated the differences show none: it would pass for their order.
    if (fits.is_scattered)
        order = hull(order, order_of_differences(with_scatter(levels, fits.scatter), fits.order));
    // The engine's errors are the steps from value to value.
    std::size_t moves = 0;
    for (std::size_t i = 1; i < levels.size(); ++i)
        moves += levels[i].value != levels[i - 1].value ? 1 : 0;
    constexpr std::size_t fewest_moves = 3;
    if (!order.determined && moves < fewest_moves)
        order.status = "an order of values needs three steps that are not zero";
    if (levels.size() < 4)
        order.status = "an order of values with an interval needs four widths";
    // Of h² − 17 h⁴ on five halved widths the interval was 1.676 ± 0.198.
    const std::size_t turn = last_turn(levels);
    if (turn > 0 && levels.size() >= fewest_past_a_turn &&
        levels.size() - turn < fewest_past_a_turn && !fits.is_scattered && !alternates(levels)) {
        order.determined = false;
        order.status = fmt::format("the values turn back at the width {:.4g}, and an order shows "
                                   "on {} levels from there on",
                                   levels[turn].h, fewest_past_a_turn);
    }
    return order;
}

/// Where the order of the steps falls so low that slow terms may be behind all that is seen: to
/// what; 0 elsewhere.
double slow_order(const LimitEstimate& result, const ValueLevels& levels,
                  const LimitTuning& tuning) {
    const auto [from, to] = result.order.falls.value_or(std::pair(infinity, infinity));
    const bool is_slow =
        to < tuning.slow_order || (to < tuning.first_order && from - to > tuning.far_fall);
    return is_slow && to > 0 && !is_erratic(levels) ? to : 0.0;
}

/// Why values have no limit, before anything is fitted; empty otherwise.
std::string without_limit(const ValueLevels& levels) {
    const bool apart = runs_apart_in_the_end(levels);
    // Those of h − 4 h² grow, too, while h falls from 1/8 to 1/16, and those of noise may.
    if ((is_significant(levels) || goes_further_than_digits(levels)) &&
        (apart || steps_grow(levels)))
        return apart ? "the values run apart" : "the steps between the values do not shrink";
    return {};
}

/// The limit of values that are all the same to the digits printed, or within their deviation.
void set_same(LimitEstimate& result, const ValueLevels& levels, double half) {
    const double value = levels.back().value;
    result.limit = {value, value - half, value + half, true, 1, ""};
    result.uncertainty = half;
    result.basis = std::to_string(levels.size()) + " levels that are the same";
    result.order.status = "the values stand still";
    result.gci.silence = result.celik.silence = result.eca_hoekstra.silence = result.order.status;
}

LimitEstimate refused(LimitEstimate result, const std::string& reason) {
    result.limit.status = result.order.status = reason;
    return result;
}

/// Of values that differ by rounding at most: their digits or their sigma may hide more.
LimitEstimate of_same(LimitEstimate result, const ValueLevels& given, double rounding) {
    constexpr double of_95 = 1.96;
    const double sigma = given.back().sigma;
    const double half = std::max(hidden_by_digits(given), is_positive(sigma) ? of_95 * sigma : 0.0);
    if (half <= rounding)
        return refused(std::move(result),
                       fmt::format("all {} values are the same to rounding: they are exact, or "
                                   "nothing is refined",
                                   given.size()));
    set_same(result, given, half);
    return result;
}

} // namespace

LimitEstimate estimate_limit(std::span<const ValueRow> rows, const LimitTuning& tuning) {
    ValueLevels given = value_levels(rows);
    LimitEstimate result;
    if (given.size() < 3)
        return refused(result, "a limit needs values at three different widths");
    if (!has_three_widths(given))
        return refused(result, "a limit needs values at three widths, each 5 % or more from the "
                               "next, and 12 % in all");
    // Rounding counts for more between levels that are closer than halved widths; closer ones than
    // an eighth show no order.
    const double halvings =
        std::log2(given.front().h / given.back().h) / static_cast<double>(given.size() - 1);
    const auto printed =
        coarsely_printed_step(given, tuning.units_of_exact_steps / std::clamp(halvings, 0.15, 1.0));
    if (printed)
        add_rounding(given);
    // No digits make values do that.
    if (const std::string reason = without_limit(given); !reason.empty())
        return refused(result, reason);
    const ScaledLevels of = scaled(given);
    const double rounding =
        roundings * std::numeric_limits<double>::epsilon() * std::abs(of.origin);
    if (const std::size_t count = standing_still(given, rounding); of.scale > rounding && count > 0)
        return refused(
            result,
            fmt::format(
                "the {} finest values are the same, and the step before was {:.2g}: they are "
                "exact, or no longer refined",
                count,
                std::abs(given[given.size() - count].value -
                         given[given.size() - count - 1].value)));
    result.finest_step = printed;
    if (of.scale <= rounding)
        return of_same(std::move(result), given, rounding);
    result.gci = gci_of(given);
    result.celik = celik_of(given);
    result.eca_hoekstra = eca_hoekstra_of(of.levels);
    if (auto& least_squares = result.eca_hoekstra) {
        least_squares->limit = of.origin + of.scale * least_squares->limit;
        least_squares->uncertainty *= of.scale;
    }
    if (const auto order = order_of_finest(given);
        is_significant(given) && order && *order < least_order)
        return refused(result, "the order of the finest values is below 0.2");
    const LimitFits fits = fit_all(of.levels, tuning);
    set_limit(result, fits, of, tuning);
    result.order = order_of(of.levels, fits);
    if (const double to = slow_order(result, of.levels, tuning); to > 0) {
        result.limit = {.status = fmt::format("the order of the steps falls over finer windows, to "
                                              "{:.2f}: how far slow terms still go, as 1/ln h, no "
                                              "model tells",
                                              to)};
        result.uncertainty = infinity;
        result.basis.clear();
    }
    return result;
}

} // namespace tvbeam
