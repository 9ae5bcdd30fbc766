#include "studies/orders/limit_engine.hpp"

#include "studies/orders/observed_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

/// An interval is no narrower than this many roundings of the finest value.
constexpr double roundings = 8;

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

using Rows = std::vector<ValueRow>;

/// Coarse to fine, finite, one row a width; of very many widths, one row a cell of ln h. Where no
/// σ is stated, it is that of values of equal widths, with Student's factor for their number.
Rows levels_of(std::span<const ValueRow> given) {
    constexpr std::size_t most_levels = 48; // less than the designs of fit_at hold
    Rows rows;
    for (const auto& row : given)
        if (is_positive(row.h) && std::isfinite(row.value))
            rows.push_back(row);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const auto& left, const auto& right) { return left.h > right.h; });
    std::size_t widths = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        widths += i == 0 || rows[i].h < rows[i - 1].h ? 1 : 0;
    const double cell =
        widths > most_levels ? std::log(rows.front().h / rows.back().h) / (most_levels - 1) : 0.0;
    Rows levels;
    std::vector<double> counts;
    double squares = 0;
    for (std::size_t i = 0, next = 0; i < rows.size(); i = next) {
        ValueRow mean{0, 0, 0, 0};
        double square = 0;
        for (next = i; next < rows.size() && rows[next].h >= rows[i].h * std::exp(-cell); ++next) {
            const double off = rows[next].value - rows[i].value;
            mean.h += rows[next].h;
            mean.value += off;
            mean.sigma += rows[next].sigma * rows[next].sigma;
            mean.unit = std::max(mean.unit, rows[next].unit);
            square += off * off;
        }
        const auto n = counts.emplace_back(static_cast<double>(next - i));
        squares += square - mean.value * mean.value / n;
        levels.push_back(
            {mean.h / n, rows[i].value + mean.value / n, std::sqrt(mean.sigma) / n, mean.unit});
    }
    const auto dof = static_cast<int>(rows.size() - levels.size());
    const double pooled = std::sqrt(squares / dof) * student_over_normal(dof);
    for (std::size_t i = 0; i < levels.size() && dof > 0 && cell == 0; ++i)
        if (std::isnan(levels[i].sigma))
            levels[i].sigma = pooled / std::sqrt(counts[i]);
    return levels;
}

/// The finest step in units of the last digit printed; none where it is `exact` of them or more.
std::optional<double> coarsely_printed_step(const Rows& levels, double exact) {
    const auto& fine = levels.back();
    const auto& coarse = levels[levels.size() - 2];
    const double step = std::abs(fine.value - coarse.value) / std::max(fine.unit, coarse.unit);
    return step < exact ? std::optional(step) : std::nullopt;
}

/// Rounding is a scatter that values of equal widths, which are rounded alike, may not show.
void add_rounding(Rows& levels) {
    const double uniform = 1 / std::sqrt(12.0); // the deviation of what is spread over one unit
    for (auto& level : levels)
        level.sigma = std::isnan(level.sigma) ? uniform * level.unit
                                              : std::max(level.sigma, uniform * level.unit);
}

/// How far from printed values that are all the same their limit may be: rounding is half a unit,
/// and what hides in a unit goes on at first order at worst.
double hidden_by_digits(const Rows& levels) {
    return levels.back().unit * (0.5 + 1 / (levels.front().h / levels.back().h - 1));
}

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

/// All windows that end at the finest level, each compared with the one a level coarser.
void weigh(const Rows& levels, const LimitModel& model, std::vector<Weighed>& limits,
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
        limits.push_back({fit->limit, std::hypot(change, fit->limit_error)});
        if (!model.order && model.logarithmic == 0)
            orders.push_back(fit->order);
    }
}

/// The deviation that the best of the models leaves, with Student's factor. Three levels do not
/// show any.
double scatter_of(const Rows& levels) {
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

/// Do the last three steps, or the two that there are, go to and fro?
bool alternates(const Rows& levels) {
    const std::size_t n = levels.size();
    const auto step = [&](std::size_t back) {
        return levels[n - back].value - levels[n - back - 1].value;
    };
    return step(1) * step(2) < 0 && (n < 4 || step(2) * step(3) < 0);
}

/// Whether the ratios of the steps rise and fall, as those of values that scatter do; of a smooth
/// sequence they go one way. Two show nothing.
bool is_erratic(const Rows& levels) {
    std::vector<double> ratios;
    for (std::size_t i = 2; i < levels.size(); ++i)
        ratios.push_back((levels[i].value - levels[i - 1].value) /
                         (levels[i - 1].value - levels[i - 2].value));
    return ratios.size() >= 3 && (!std::is_sorted(ratios.begin(), ratios.end()) &&
                                  !std::is_sorted(ratios.rbegin(), ratios.rend()));
}

/// Is the finest step more than what the known deviations make of no step at all?
bool is_significant(const ValueRow& coarse, const ValueRow& fine) {
    constexpr double deviations = 3;
    const double sigma = std::hypot(fine.sigma, coarse.sigma);
    return !(std::abs(fine.value - coarse.value) <= deviations * sigma);
}

bool is_significant(const Rows& levels) {
    return is_significant(levels[levels.size() - 2], levels.back());
}

/// Whether all steps together are more than rounding to the digits printed makes, if none of them
/// is. Of scatter that is more than rounding each step must be.
bool goes_further_than_digits(const Rows& levels) {
    constexpr double units = 4;
    const double unit = levels.back().unit;
    return unit > 0 && levels.front().sigma <= unit && levels.back().sigma <= unit &&
           std::abs(levels.back().value - levels.front().value) >= units * unit;
}

/// The steps between levels, each over the logarithm of its ratio.
std::vector<double> steps_of(const Rows& levels) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < levels.size(); ++i)
        steps.push_back((levels[i].value - levels[i - 1].value) /
                        std::log(levels[i - 1].h / levels[i].h));
    return steps;
}

constexpr double equal_steps = 1 - 1e-6; // those of ln h are, but for rounding

/// Do the values go one way in steps that grow up to the finest, while h falls further than steps
/// of a sum of two powers can grow? Those of C h^p + D h^q with opposite signs do from their zero
/// to their greatest, while h falls by (q/p)^(1/(q − p)): 2 of h − h², 4 of √h − h; and by one
/// ratio of levels more, as the greatest may lie between two.
bool runs_apart_in_the_end(const Rows& levels) {
    const auto steps = steps_of(levels);
    constexpr double growing = 4;
    constexpr double rounding = 1 + 1e-9;
    std::size_t first = steps.size() - 1;
    double ratio = levels[first].h / levels[first + 1].h; // the greatest
    while (first > 0 && steps[first - 1] * steps[first] > 0 &&
           equal_steps * std::abs(steps[first - 1]) <= std::abs(steps[first]) &&
           is_significant(levels[first - 1], levels[first])) {
        --first;
        ratio = std::max(ratio, levels[first].h / levels[first + 1].h);
    }
    return levels[first].h > growing * ratio * rounding * levels[steps.size() - 1].h;
}

/// Do the values go one way, or to and fro throughout, and the steps between levels, each over the
/// logarithm of its ratio, grow towards the finest, which is the greatest of all? Those of h^p
/// shrink for every p > 0, so that no limit is in sight.
bool steps_grow(const Rows& levels) {
    std::vector<double> steps = steps_of(levels);
    const bool to_and_fro = steps[0] * steps[1] < 0;
    for (std::size_t i = 1; i < steps.size(); ++i)
        if ((steps[i] * steps[i - 1] < 0) != to_and_fro)
            return false;
    for (auto& step : steps)
        step = std::abs(step);
    const std::size_t last = steps.size() - 1;
    for (std::size_t i = 0; i < last; ++i)
        if (steps[last] < equal_steps * steps[i] ||
            (i + 2 >= last && steps[i + 1] < equal_steps * steps[i]))
            return false;
    return steps[last] >
           roundings * std::numeric_limits<double>::epsilon() * std::abs(levels.back().value);
}

/// The levels less the finest value and over the greatest distance from it, so that no square of
/// theirs leaves the range of doubles. The scale is zero where the values are all the same.
struct ScaledRows {
    Rows levels;
    double origin = 0;
    double scale = 0;
};

ScaledRows scaled(const Rows& levels) {
    ScaledRows result{levels, levels.back().value};
    for (auto& row : result.levels) {
        row.value -= result.origin;
        result.scale = std::max(result.scale, std::abs(row.value));
    }
    if (result.scale > 0)
        for (auto& row : result.levels) {
            row.value /= result.scale;
            row.sigma /= result.scale;
        }
    return result;
}

/// The levels from the last at which the values turn back, where three differences or more follow:
/// next to a turn differences are small, as of a steeper order.
Rows past_the_turn(const Rows& levels) {
    constexpr std::size_t fewest = 4; // levels
    std::size_t first = 0;
    for (std::size_t k = 1; k + 1 < levels.size(); ++k)
        if ((levels[k].value - levels[k - 1].value) * (levels[k + 1].value - levels[k].value) < 0)
            first = k;
    return levels.size() - first < fewest
               ? levels
               : Rows(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end());
}

/// The order of the differences between consecutive levels, as the engine of orders sees that of
/// errors. Of f_0 + C h^p + D h^{p+1} they are, over (h_k^p − h_{k+1}^p) / H_k^p with the widths
///
///     H_k = (h_k^{p+1} − h_{k+1}^{p+1}) / (h_k^p − h_{k+1}^p),
///
/// C H_k^p + D H_k^{p+1}, whatever the ratios of the widths. p is the order found before;
/// from_models: the first.
OrderInterval order_of_differences(const Rows& given, double from_models) {
    OrderInterval order;
    const Rows levels = past_the_turn(given);
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
                                   std::hypot(levels[k].sigma, levels[k + 1].sigma) / step});
        }
        // Those of values that go to and fro leave residuals that are no scatter.
        order = estimate_orders(differences, {}, {.contradicted = infinity}).front();
        if (!(order.value > 0))
            break;
        p = order.value;
    }
    return order;
}

/// How many of the finest values are one, to the digits that they have, though the steps before
/// show no such order: a solver that is exact from there on, or one that refines no more, or a
/// maximum over nodes that stays at one of them. After one step every order that a method has may
/// have led there; of two steps the order goes on; and from three on it may grow as that of what
/// converges exponentially, like exp(−c/h). 0 where the values move, or may have converged.
std::size_t standing_still(const Rows& levels, double rounding) {
    const auto& finest = levels.back();
    const auto is_same = [&](const ValueRow& row) {
        return std::abs(row.value - finest.value) <= std::max(rounding, finest.unit / 2);
    };
    std::size_t first = levels.size() - 1; // of those that are one
    while (first > 0 && is_same(levels[first - 1]))
        --first;
    const std::size_t count = levels.size() - first;
    constexpr std::size_t fewest = 3; // of two every window has a step
    if (count < fewest || first == 0)
        return 0;
    constexpr double deviations = 3;
    const double scatter = is_positive(finest.sigma) ? deviations * finest.sigma : 0.0;
    const double resolution = std::max({rounding, finest.unit, scatter});
    const double last = std::abs(levels[first].value - levels[first - 1].value);
    const double ratio = levels[first - 1].h / levels[first].h;
    if (first == 1)
        return last > resolution * std::pow(ratio, greatest_order) ? count : 0;
    const double before = std::abs(levels[first - 1].value - levels[first - 2].value);
    const double shrinks = before > last ? last / before : 1.0;
    const double next = last * std::pow(shrinks, first < 3 ? 1.0 : std::max(2.0, ratio));
    constexpr double of_steps = 3; // rounding moves each step by one
    return next > of_steps * resolution ? count : 0;
}

Rows with_scatter(Rows levels, double scatter) {
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

/// Of 60 limits from four levels 1 % apart the intervals of 6 missed, of 58 3 % apart those of 3.
bool has_three_widths(const Rows& levels) {
    constexpr double least_ratio = 1.05;
    int widths = 1;
    double coarser = levels.front().h;
    for (const auto& level : levels)
        if (coarser >= least_ratio * level.h) {
            ++widths;
            coarser = level.h;
        }
    return widths >= 3 && levels.front().h >= OrderTuning{}.one_level * levels.back().h;
}

} // namespace

LimitEstimate estimate_limit(std::span<const ValueRow> rows, const LimitTuning& tuning) {
    Rows given = levels_of(rows);
    LimitEstimate result;
    if (given.size() < 3) {
        result.limit.status = result.order.status =
            "a limit needs values at three different widths";
        return result;
    }
    if (!has_three_widths(given)) {
        result.limit.status = result.order.status =
            "a limit needs values at three widths, each 5 % or more from the next, and 12 % in all";
        return result;
    }
    // Rounding counts for more between levels that are closer than halved widths; closer ones than
    // an eighth show no order.
    const double halvings =
        std::log2(given.front().h / given.back().h) / static_cast<double>(given.size() - 1);
    result.finest_step =
        coarsely_printed_step(given, tuning.units_of_exact_steps / std::clamp(halvings, 0.15, 1.0));
    if (result.finest_step)
        add_rounding(given);
    const bool apart = runs_apart_in_the_end(given);
    if ((is_significant(given) || goes_further_than_digits(given)) &&
        (apart || steps_grow(given))) {
        // Those of h − 4 h² grow, too, while h falls from 1/8 to 1/16, and those of noise may.
        result.limit.status = result.order.status =
            apart ? "the values run apart" : "the steps between the values do not shrink";
        result.finest_step.reset(); // no digits make them do that
        return result;
    }
    const auto [levels, origin, scale] = scaled(given);
    const double rounding = roundings * std::numeric_limits<double>::epsilon() * std::abs(origin);
    if (scale <= rounding) {
        const double half = std::max(rounding, hidden_by_digits(given));
        result.limit = {origin, origin - half, origin + half, true, 1, ""};
        result.uncertainty = half;
        result.basis = std::to_string(levels.size()) + " levels that are the same";
        result.order.status = "the values stand still";
        return result;
    }
    if (const std::size_t count = standing_still(given, rounding); count > 0) {
        result.limit.status = result.order.status = fmt::format(
            "the {} finest values are the same, and the step before was {:.2g}: they are exact, or "
            "no longer refined",
            count,
            std::abs(given[given.size() - count].value - given[given.size() - count - 1].value));
        result.finest_step.reset();
        return result;
    }
    result.gci = gci_of(given);
    result.celik = celik_of(given);
    result.eca_hoekstra = eca_hoekstra_of(levels);
    if (auto& least_squares = result.eca_hoekstra) {
        least_squares->limit = origin + scale * least_squares->limit;
        least_squares->uncertainty *= scale;
    }
    if (const auto order = order_of_finest(given);
        is_significant(given) && order && *order < least_order) {
        result.limit.status = result.order.status = "the order of the finest values is below 0.2";
        return result;
    }
    std::vector<Weighed> limits;
    std::vector<double> orders;
    std::vector<Weighed> with_logarithms;
    for (const auto& model : limit_models)
        if (!model.alternating || alternates(levels))
            weigh(levels, model, model.logarithmic > 0 ? with_logarithms : limits, orders);
    std::sort(orders.begin(), orders.end());
    const double first = orders.empty() ? 1.0 : orders[orders.size() / 2];
    const double last_step = std::abs(levels[levels.size() - 2].value - levels.back().value);
    const auto spare = static_cast<double>(levels.size()) - 2;
    const double scatter = scatter_of(levels);
    const bool is_scattered = last_step < tuning.exact_steps * scatter;
    // Where values scatter every low order follows them, and every logarithm.
    if (is_scattered || !(first < tuning.logarithmic_below))
        with_logarithms.clear();
    with_logarithms.insert(with_logarithms.end(), limits.begin(), limits.end());
    const bool is_wider = is_scattered && is_erratic(levels);
    const double factor =
        (is_wider ? tuning.scattered : tuning.factor) * (1 + tuning.few_levels / (spare * spare));
    // What the doubles of the values do not know, in units of the scale.
    const double unknown =
        std::max(rounding / scale, roundings * std::numeric_limits<double>::epsilon());
    const double agreement = tuning.agreement * last_step + unknown;
    if (const auto mean = mean_of(limits, agreement)) {
        const auto half_of = [&](const Mean& of) {
            return std::abs(of.value - mean->value) + factor * of.spread +
                   tuning.narrowest * std::abs(of.value) + unknown;
        };
        const double half = std::max(
            scale * std::max(half_of(*mean), half_of(*mean_of(with_logarithms, agreement))),
            std::max(given.back().unit / 2, is_wider ? scale * scatter : 0.0));
        const double limit = origin + scale * mean->value;
        if (!std::isfinite(limit) || !std::isfinite(half)) {
            result.limit.status = "values or deviations of so many sizes overflow";
            return result;
        }
        result.limit = {.value = limit,
                        .low = limit - half,
                        .high = limit + half,
                        .determined = true,
                        .share = 1,
                        .status = ""};
        result.uncertainty = scale * std::abs(mean->value) + half;
        result.basis =
            std::to_string(levels.size()) + " levels, " + std::to_string(limits.size()) + " fits";
    } else {
        result.limit.status = "no model fits";
    }
    result.order = order_of_differences(levels, first);
    // Of scatter that is not stated the differences show none: it would pass for their order.
    if (is_scattered)
        result.order =
            hull(result.order, order_of_differences(with_scatter(levels, scatter), first));
    // The engine's errors are the steps from value to value.
    std::size_t moves = 0;
    for (std::size_t i = 1; i < levels.size(); ++i)
        moves += levels[i].value != levels[i - 1].value ? 1 : 0;
    constexpr std::size_t fewest_moves = 3;
    if (!result.order.determined && moves < fewest_moves)
        result.order.status = "an order of values needs three steps that are not zero";
    if (levels.size() < 4)
        result.order.status = "an order of values with an interval needs four widths";
    const auto [from, to] = result.order.falls.value_or(std::pair(infinity, infinity));
    const bool is_slow =
        to < tuning.slow_order || (to < tuning.first_order && from - to > tuning.far_fall);
    if (!is_erratic(levels) && to > 0 && is_slow) {
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
