#include "studies/orders/limit_engine.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

constexpr double least_order = 0.2;
constexpr double greatest_order = 8;
/// An interval is no narrower than this many roundings of the finest value.
constexpr double roundings = 8;

/// A model of f: powers of h beside the constant. One that is free is searched for.
struct LimitModel {
    std::optional<double> order; ///< none: free
    bool next = false;           ///< a further term of one power more
    bool alternating = false;    ///< C changes its sign from level to level
    int parameters() const { return 2 + (order ? 0 : 1) + (next ? 1 : 0); }
};

const LimitModel limit_models[] = {{std::nullopt, false}, {1.0, false},
                                   {2.0, false},          {1.0, true},
                                   {std::nullopt, true},  {std::nullopt, false, true}};

struct LinearFit {
    double limit = 0;
    double limit_error = 0; ///< over 1.96 it is an interval's half; 0 without residuals and σ
    double order = 0;
    double square = infinity; ///< sum of weighted squares
    double finest = 0;        ///< the model's value at the finest level
    int dof = 0;
};

using Rows = std::vector<ValueRow>;

/// 1/σ² over its mean, and the standard deviation at weight one, 0 where it is not known.
struct Weights {
    Eigen::VectorXd relative;
    double scatter = 0;
};

/// The standard deviation at weight one: from the residuals, with Student's factor, or known.
double deviation_of(const LinearFit& fit, const Weights& weights) {
    return std::max(fit.dof > 0 ? std::sqrt(fit.square / fit.dof) * student_over_normal(fit.dof)
                                : 0.0,
                    weights.scatter);
}

/// For a given order all else is linear.
LinearFit fit_at(std::span<const ValueRow> rows, const Weights& weights, double order,
                 const LimitModel& model) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    const int columns = model.next ? 3 : 2;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 64, 3> design(n, columns);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 64, 1> right(n);
    const double unit = rows.front().h;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto& row = rows[static_cast<std::size_t>(i)];
        const double x = row.h / unit;
        const double w = std::sqrt(weights.relative[i]);
        design(i, 0) = w;
        design(i, 1) = w * std::pow(x, order);
        if (model.alternating && i % 2 == 1)
            design(i, 1) = -design(i, 1);
        if (model.next)
            design(i, 2) = design(i, 1) * x;
        right[i] = w * (row.value - rows.back().value);
    }
    const Eigen::HouseholderQR<decltype(design)> qr(design);
    const Eigen::VectorXd x = qr.solve(right);
    LinearFit fit{.limit = rows.back().value + x[0],
                  .order = order,
                  .square = (right - design * x).squaredNorm(),
                  .dof = static_cast<int>(n) - model.parameters()};
    fit.finest = rows.back().value + design.row(n - 1).dot(x) / std::sqrt(weights.relative[n - 1]);
    if (const double deviation = deviation_of(fit, weights); deviation > 0) {
        const Eigen::MatrixXd root =
            qr.matrixQR().topRows(columns).template triangularView<Eigen::Upper>().solve(
                Eigen::MatrixXd::Identity(columns, columns));
        fit.limit_error = deviation * root.row(0).norm();
    }
    return fit;
}

/// The best order within the bounds; none at a bound.
std::optional<LinearFit> fit_limit_model(std::span<const ValueRow> rows, const Weights& weights,
                                         const LimitModel& model) {
    if (static_cast<int>(rows.size()) < model.parameters())
        return std::nullopt;
    const auto at = [&](double p) { return fit_at(rows, weights, p, model); };
    if (model.order)
        return at(*model.order);
    constexpr int net = 24;
    const double step = std::log(greatest_order / least_order) / net;
    int best = 0;
    double least = infinity;
    for (int k = 0; k <= net; ++k)
        if (const double square = at(least_order * std::exp(k * step)).square; square < least) {
            least = square;
            best = k;
        }
    if (best == 0 || best == net)
        return std::nullopt;
    double low = least_order * std::exp((best - 1) * step);
    double high = least_order * std::exp((best + 1) * step);
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (int k = 0; k < 40; ++k) {
        const double left = high - golden * (high - low);
        const double right = low + golden * (high - low);
        (at(left).square < at(right).square ? high : low) =
            at(left).square < at(right).square ? right : left;
    }
    auto fit = at((low + high) / 2);
    // The standard error at the best order knows nothing of the order's own: that of the linearised
    // model does.
    if (const double deviation = deviation_of(fit, weights); deviation > 0) {
        const double d = 1e-3 * fit.order;
        const auto above = at(fit.order + d), below = at(fit.order - d);
        const double curvature = (above.square + below.square - 2 * fit.square) / (d * d) / 2;
        const double slope = (above.limit - below.limit) / (2 * d);
        if (curvature > 0)
            fit.limit_error =
                std::hypot(fit.limit_error, std::abs(slope) * deviation / std::sqrt(curvature));
    }
    return fit;
}

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
        ValueRow mean{0, 0, 0};
        double square = 0;
        for (next = i; next < rows.size() && rows[next].h >= rows[i].h * std::exp(-cell); ++next) {
            const double off = rows[next].value - rows[i].value;
            mean.h += rows[next].h;
            mean.value += off;
            mean.sigma += rows[next].sigma * rows[next].sigma;
            square += off * off;
        }
        const auto n = counts.emplace_back(static_cast<double>(next - i));
        squares += square - mean.value * mean.value / n;
        levels.push_back({mean.h / n, rows[i].value + mean.value / n, std::sqrt(mean.sigma) / n});
    }
    const auto dof = static_cast<int>(rows.size() - levels.size());
    const double pooled = std::sqrt(squares / dof) * student_over_normal(dof);
    for (std::size_t i = 0; i < levels.size() && dof > 0 && cell == 0; ++i)
        if (std::isnan(levels[i].sigma))
            levels[i].sigma = pooled / std::sqrt(counts[i]);
    return levels;
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
            // A limit with the wrong order goes on like h^½ at worst, one with the right order like
            // the next term.
            const double rate = model.order ? std::sqrt(ratio) : ratio;
            change = std::abs(coarser->limit - fit->limit) / (rate - 1);
            compared = true;
        }
        if (!compared || !std::isfinite(fit->limit_error))
            continue;
        limits.push_back({fit->limit, std::hypot(change, fit->limit_error)});
        if (!model.order)
            orders.push_back(fit->order);
    }
}

/// Do the last three steps, or the two that there are, go to and fro?
bool alternates(const Rows& levels) {
    const std::size_t n = levels.size();
    const auto step = [&](std::size_t back) {
        return levels[n - back].value - levels[n - back - 1].value;
    };
    return step(1) * step(2) < 0 && (n < 4 || step(2) * step(3) < 0);
}

/// Is the finest step more than what the known deviations make of no step at all?
bool is_significant(const Rows& levels) {
    constexpr double deviations = 3;
    const auto& fine = levels.back();
    const auto& coarse = levels[levels.size() - 2];
    const double sigma = std::hypot(fine.sigma, coarse.sigma);
    return !(std::abs(fine.value - coarse.value) <= deviations * sigma);
}

/// Do the values go one way, or to and fro throughout, and the steps between levels, each over the
/// logarithm of its ratio, grow towards the finest, which is the greatest of all? Those of h^p
/// shrink for every p > 0, so that there is no limit.
bool runs_apart(const Rows& levels) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < levels.size(); ++i)
        steps.push_back((levels[i].value - levels[i - 1].value) /
                        std::log(levels[i - 1].h / levels[i].h));
    const bool to_and_fro = steps[0] * steps[1] < 0;
    for (std::size_t i = 1; i < steps.size(); ++i)
        if ((steps[i] * steps[i - 1] < 0) != to_and_fro)
            return false;
    for (auto& step : steps)
        step = std::abs(step);
    constexpr double equal = 1 - 1e-6; // steps of ln h are equal, but for rounding
    const std::size_t last = steps.size() - 1;
    for (std::size_t i = 0; i < last; ++i)
        if (steps[last] < equal * steps[i] || (i + 2 >= last && steps[i + 1] < equal * steps[i]))
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

/// The order of the differences between consecutive levels, as the engine of orders sees that of
/// errors: f_k − f_{k+1} = C h_k^p (1 − r_k^{−p}) + … with the ratios r_k of the widths, which are
/// divided out with the order found before; from_models: the first.
OrderInterval order_of_differences(const Rows& levels, double from_models) {
    OrderInterval order;
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
            differences.push_back({{levels[k].h},
                                   step / -std::expm1(-p * std::log(levels[k].h / levels[k + 1].h)),
                                   std::hypot(levels[k].sigma, levels[k + 1].sigma) / step});
        }
        order = estimate_orders(differences).front();
        if (!(order.value > 0))
            break;
        p = order.value;
    }
    return order;
}

} // namespace

LimitEstimate estimate_limit(std::span<const ValueRow> rows, const LimitTuning& tuning) {
    const Rows given = levels_of(rows);
    LimitEstimate result;
    if (given.size() < 3) {
        result.limit.status = result.order.status =
            "a limit needs values at three different widths";
        return result;
    }
    if (is_significant(given) && runs_apart(given)) {
        result.limit.status = result.order.status = "the values run apart";
        return result;
    }
    const auto [levels, origin, scale] = scaled(given);
    const double rounding = roundings * std::numeric_limits<double>::epsilon() * std::abs(origin);
    if (scale <= rounding) {
        result.limit = {origin, origin - rounding, origin + rounding, true, 1, ""};
        result.uncertainty = rounding;
        result.basis = std::to_string(levels.size()) + " levels that are the same";
        result.order.status = "the values stand still";
        return result;
    }
    result.gci = gci_of(given);
    result.celik = celik_of(given);
    result.eca_hoekstra = eca_hoekstra_of(given);
    if (is_significant(given) && result.gci && result.gci->order < least_order) {
        result.limit.status = result.order.status = "the order of the finest values is below 0.2";
        return result;
    }
    std::vector<Weighed> limits;
    std::vector<double> orders;
    for (const auto& model : limit_models)
        if (!model.alternating || alternates(levels))
            weigh(levels, model, limits, orders);
    const double last_step = std::abs(levels[levels.size() - 2].value - levels.back().value);
    const auto spare = static_cast<double>(levels.size()) - 2;
    const double factor = tuning.factor * (1 + tuning.few_levels / (spare * spare));
    // What the doubles of the values do not know, in units of the scale.
    const double unknown =
        std::max(rounding / scale, roundings * std::numeric_limits<double>::epsilon());
    if (const auto mean = mean_of(limits, tuning.agreement * last_step + unknown)) {
        const double half =
            scale * (factor * mean->spread + tuning.narrowest * std::abs(mean->value) + unknown);
        const double limit = origin + scale * mean->value;
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
    std::sort(orders.begin(), orders.end());
    result.order = order_of_differences(levels, orders.empty() ? 1.0 : orders[orders.size() / 2]);
    if (levels.size() < 4)
        result.order.status = "an order of values with an interval needs four widths";
    return result;
}

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
std::optional<MethodLimit> gci_of(std::span<const ValueRow> levels) {
    if (levels.size() < 3)
        return std::nullopt;
    const auto& fine = levels[levels.size() - 1];
    const auto& medium = levels[levels.size() - 2];
    const auto& coarse = levels[levels.size() - 3];
    const double log_fine = std::log(medium.h / fine.h);
    const double log_coarse = std::log(coarse.h / medium.h);
    const double step = medium.value - fine.value;
    const double quotient = (coarse.value - medium.value) / step;
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
    constexpr double no_order = 1e-3; // steps that stay the same, but for rounding
    if (high < no_order)
        return std::nullopt;
    const double gain = std::expm1(high * log_fine);
    // Three grids whose order no common method has are not in the asymptotic range: the factor of
    // two grids, and no order above that (Oberkampf and Roy 2010, 8.6).
    constexpr double greatest_believed = 4;
    if (high > 1.1 * greatest_believed)
        return MethodLimit{fine.value - step / gain,
                           3 * std::abs(step) / std::expm1(greatest_believed * log_fine), high,
                           "f0 + C h^p; order above 4: factor 3, order 4 in the uncertainty"};
    constexpr double safety = 1.25; // of an order observed on three grids
    return MethodLimit{fine.value - step / gain, safety * std::abs(step) / gain, high,
                       "f0 + C h^p"};
}

std::optional<MethodLimit> celik_of(std::span<const ValueRow> levels) {
    if (levels.size() < 3)
        return std::nullopt;
    const auto& fine = levels[levels.size() - 1];
    const auto& medium = levels[levels.size() - 2];
    const auto& coarse = levels[levels.size() - 3];
    const double r21 = medium.h / fine.h;
    const double r32 = coarse.h / medium.h;
    const double e21 = medium.value - fine.value;
    const double e32 = coarse.value - medium.value;
    if (e21 == 0 || e32 == 0)
        return std::nullopt;
    const double sign = e32 / e21 < 0 ? -1 : 1;
    double p = std::abs(std::log(std::abs(e32 / e21))) / std::log(r21);
    for (int k = 0; k < 200 && std::isfinite(p); ++k)
        p = std::abs(std::log(std::abs(e32 / e21)) +
                     std::log((std::pow(r21, p) - sign) / (std::pow(r32, p) - sign))) /
            std::log(r21);
    if (!(p > 0) || !std::isfinite(p))
        return std::nullopt;
    const double gain = std::pow(r21, p) - 1;
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
    auto best = candidate({std::nullopt, false}, "f0 + C h^p");
    const double order = best ? best->fit.order : 0;
    if (best && order >= 0.5 && order <= 2)
        return best;
    best = candidate({1.0, false}, "f0 + C h");
    const auto prefer = [&](const std::optional<Candidate>& other) {
        if (other && (!best || other->deviation < best->deviation))
            best = other;
    };
    prefer(candidate({2.0, false}, "f0 + C h^2"));
    if (order < 0.5)
        prefer(candidate({1.0, true}, "f0 + C h + D h^2"));
    return best;
}

} // namespace

std::optional<MethodLimit> eca_hoekstra_of(std::span<const ValueRow> levels) {
    const std::size_t n = levels.size();
    if (n < 4)
        return std::nullopt;
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
        return std::nullopt;
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
