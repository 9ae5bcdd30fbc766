#include "studies/orders/order_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

namespace tvbeam {

namespace {

constexpr std::size_t fewest_levels = 3;
constexpr int logarithmic_family = 3; // among the shapes of a sequence
/// Rows where the others are finest: all, and those of this many finest levels.
constexpr int finest_levels[] = {3, 2, 1};

using Index = Eigen::Index;

/// Rows with a logarithm; those of one cell are one row of their mean, and of the sum of their
/// weights 1/σ². A cell is one point of the widths, or, where there are too many rows, of a
/// lattice. Without σ it is taken from rows of one point, with Student's factor for their number.
TermRows usable_rows(std::span<const ErrorRow> given, const OrderTuning& tuning) {
    const auto d = given.empty() ? Index{0} : static_cast<Index>(given.front().widths.size());
    const auto usable = [](const ErrorRow& row) {
        return is_positive(row.error) &&
               std::all_of(row.widths.begin(), row.widths.end(), is_positive);
    };
    const bool stated = std::all_of(given.begin(), given.end(), [&](const ErrorRow& row) {
        return !usable(row) || is_positive(row.sigma);
    });
    std::vector<Eigen::VectorXd> points; // ln of the widths and the error, and the weight
    Eigen::VectorXd least = Eigen::VectorXd::Constant(d, infinity);
    Eigen::VectorXd greatest = -least;
    for (const auto& row : given)
        if (usable(row)) {
            Eigen::VectorXd point(d + 2);
            for (Index i = 0; i < d; ++i)
                point[i] = std::log(row.widths[static_cast<std::size_t>(i)]);
            point[d] = std::log(row.error);
            point[d + 1] = stated ? 1 / (row.sigma * row.sigma) : 1.0;
            least = least.cwiseMin(point.head(d));
            greatest = greatest.cwiseMax(point.head(d));
            points.push_back(std::move(point));
        }
    const double most = static_cast<double>(tuning.most_rows);
    const Eigen::VectorXd cell =
        (greatest - least) / std::max(1.0, std::pow(most, 1 / static_cast<double>(d)) - 1);
    struct Sum {
        Eigen::VectorXd sum;
        double weight = 0;
        int count = 0;
        double mean = 0, squares = 0; ///< of ln e, by Welford's recurrence
    };
    std::map<std::vector<double>, Sum> cells;
    std::vector<double> key(static_cast<std::size_t>(d));
    const bool lattice = points.size() > tuning.most_rows;
    for (const auto& point : points) {
        for (Index i = 0; i < d; ++i)
            key[static_cast<std::size_t>(i)] =
                lattice && cell[i] > 0 ? std::floor((point[i] - least[i]) / cell[i]) : point[i];
        auto& [sum, weight, count, mean, squares] = cells[key];
        if (count++ == 0)
            sum = Eigen::VectorXd::Zero(d + 1);
        sum += point[d + 1] * point.head(d + 1);
        weight += point[d + 1];
        const double off = point[d] - mean;
        mean += off / count;
        squares += off * (point[d] - mean);
    }
    const auto n = static_cast<Index>(cells.size());
    TermRows rows{Eigen::MatrixXd(n, d), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    Index r = 0;
    double squares = 0;
    for (const auto& [at, one] : cells) {
        squares += one.squares;
        rows.log_widths.row(r) = one.sum.head(d).transpose() / one.weight;
        rows.log_errors[r] = one.sum[d] / one.weight;
        rows.weights[r++] = one.weight;
    }
    if (n == 0)
        return rows;
    const double mean_weight = rows.weights.mean();
    rows.weights /= mean_weight;
    if (stated)
        rows.scatter = 1 / std::sqrt(mean_weight);
    else if (const auto dof = static_cast<int>(points.size()) - static_cast<int>(n);
             dof > 0 && squares > 0 && !lattice)
        rows.scatter = std::sqrt(squares / dof / mean_weight) * student_over_normal(dof);
    return rows;
}

/// ln of the coarsest width of each level, coarse to fine; a level is what lies within one factor.
std::vector<double> levels_of(Eigen::VectorXd log_widths, double one_level) {
    std::sort(log_widths.begin(), log_widths.end(), std::greater<>());
    std::vector<double> levels;
    for (const double width : log_widths)
        if (levels.empty() || width < levels.back() - std::log(one_level))
            levels.push_back(width);
    return levels;
}

/// What is left of a drift after one level, over that on halved widths: of a next term half an
/// order away, which falls by r^(-1/2) from level to level, Σ r^(-k/2) = 1/(1 - r^(-1/2)). 1 on
/// coarser ladders.
double drift_left(const std::vector<double>& levels) {
    const double step = (levels.front() - levels.back()) / static_cast<double>(levels.size() - 1);
    return std::max(1.0, (1 - std::sqrt(0.5)) / (1 - std::exp(-step / 2)));
}

int level_of(const std::vector<double>& levels, double log_width) {
    const auto finer = std::upper_bound(levels.begin(), levels.end(), log_width, std::greater<>());
    // The last level that is not finer than the width.
    const auto exact = std::find(levels.begin(), levels.end(), log_width);
    return static_cast<int>((exact != levels.end() ? exact : finer - 1) - levels.begin());
}

/// How many of the coarsest levels a window may leave out: the rest is at least three, and half.
int most_dropped(std::size_t levels) {
    constexpr int most = 6; // more windows cost time alone
    const auto spare = static_cast<int>(levels) - static_cast<int>(fewest_levels);
    return std::max(0, std::min({spare, static_cast<int>(levels) / 2, most}));
}

/// The leading terms; next terms in one width; next terms in all; next terms half an order on,
/// logarithms and constants, in one width, the others without or with next terms.
std::vector<TermShape> shapes_of(std::size_t widths) {
    const std::vector<double> plain(widths, TermShape::none);
    std::vector<TermShape> shapes{{plain}};
    for (const double power : {1.0, 2.0}) {
        for (std::size_t i = 0; i < widths; ++i) {
            auto next = plain;
            next[i] = power;
            shapes.push_back({next});
        }
        if (widths > 1)
            shapes.push_back({std::vector<double>(widths, power)});
    }
    if (widths == 1)
        return shapes;
    // Of one width, and of all others.
    constexpr std::pair<double, double> kinds[] = {{0.5, TermShape::none},
                                                   {TermShape::logarithm, TermShape::none},
                                                   {TermShape::constant, TermShape::none},
                                                   {0.5, 1.0},
                                                   {TermShape::logarithm, 0.5},
                                                   {TermShape::logarithm, 1.0},
                                                   {TermShape::logarithm, 2.0}};
    for (const auto& [of_one, of_others] : kinds)
        for (std::size_t i = 0; i < widths; ++i) {
            std::vector<double> next(widths, of_others);
            next[i] = of_one;
            shapes.push_back({next});
        }
    return shapes;
}

bool has_next_terms_of_two_kinds(const TermShape& shape) {
    std::vector<double> kinds = shape.next;
    std::erase(kinds, TermShape::none);
    return std::ranges::adjacent_find(kinds, std::ranges::not_equal_to()) != kinds.end();
}

/// Whether the largest term is far larger than the error in every row: the error is then a
/// difference of two, whose orders are close to each other, or to zero, and stand for a curve that
/// no power has. Of a term that a reference has as well, what is left of it counts.
bool is_a_difference(const TermFit& fit, const TermRows& rows) {
    constexpr double far_larger = 10;
    const auto hidden = [&](Index i) {
        const bool has_one = rows.log_reference.size() > 0 && !std::isnan(rows.log_reference[i]);
        return has_one ? fit.term(i, rows.log_reference[i]) : 0.0;
    };
    for (Index r = 0; r < rows.size(); ++r) {
        double largest = 0;
        for (Index i = 0; i < rows.widths(); ++i)
            largest = std::max(largest, fit.term(i, rows.log_widths(r, i)) - hidden(i));
        if (largest <= far_larger * std::exp(rows.log_errors[r]))
            return false;
    }
    return true;
}

/// Whether a fit with a logarithm has none: it is then that of the leading terms, and nothing tells
/// its order from the size of the logarithm.
bool has_lost_its_logarithm(const TermFit& fit) {
    constexpr double least = 1e-3;
    for (std::size_t i = 0; i < fit.shape.next.size(); ++i)
        if (fit.shape.next[i] == TermShape::logarithm &&
            std::abs(fit.next(static_cast<Index>(i))) < least)
            return true;
    return false;
}

bool is_believable(const TermFit& fit, const TermRows& rows) {
    return !is_a_difference(fit, rows) && !has_lost_its_logarithm(fit);
}

/// All combinations of 0 … most[i].
std::vector<std::vector<int>> places_within(const std::vector<int>& most) {
    std::vector<std::vector<int>> places{std::vector<int>(most.size(), 0)};
    for (std::size_t i = 0; i < most.size(); ++i) {
        const auto before = places;
        for (int k = 1; k <= most[i]; ++k)
            for (auto place : before) {
                place[i] = k;
                places.push_back(place);
            }
    }
    return places;
}

} // namespace

OrderEnsemble::OrderEnsemble(std::span<const ErrorRow> rows, std::vector<double> reference,
                             const OrderTuning& tuning)
    : tuning_(tuning), rows_(usable_rows(rows, tuning)) {
    if (!reference.empty())
        rows_.log_reference =
            Eigen::Map<const Eigen::ArrayXd>(reference.data(), static_cast<Index>(reference.size()))
                .log();
    for (Index i = 0; i < rows_.widths(); ++i) {
        levels_.push_back(levels_of(rows_.log_widths.col(i), tuning_.one_level));
        if (levels_.back().size() < fewest_levels)
            failure_ = levels_.back().size() == 1
                           ? "all rows have the same width, or nearly"
                           : "an order needs errors at three widths that differ by an eighth or "
                             "more";
    }
    if (rows_.size() < 2)
        failure_ = rows_.size() == 0 ? "no row has a positive error"
                                     : "one width alone has a positive error";
    if (!failure_.empty())
        return;
    // Known scatter hides from the models with a next term what they would say of it.
    // Three levels make intervals as wide as that already.
    for (const auto& levels : levels_)
        stretch_.push_back(rows_.scatter > 0 && levels.size() > fewest_levels ? drift_left(levels)
                                                                              : 1.0);
    if (rows_.widths() == 1) {
        fit_sequence(rows_);
        return;
    }
    fit_all_widths(rows_);
    fit_each_alone(rows_);
}

/// One width: windows down to the two finest levels, for models that have no more parameters than
/// the window has levels.
void OrderEnsemble::fit_sequence(const TermRows& rows) {
    const std::vector<TermShape> shapes{
        {{TermShape::none}},       {{1.0}}, {{2.0}}, {{TermShape::logarithm}},
        {{TermShape::none}, true}, {{0.5}}};
    const auto& levels = levels_.front();
    constexpr std::size_t most_windows = 24;
    const auto step = static_cast<int>(1 + levels.size() / most_windows);
    for (int place = 0; place * step + 2 <= static_cast<int>(levels.size()); ++place) {
        const int dropped = place * step;
        std::vector<Index> chosen;
        for (Index r = 0; r < rows.size(); ++r)
            if (level_of(levels, rows.log_widths(r, 0)) >= dropped)
                chosen.push_back(r);
        const auto window = rows.subset(chosen);
        for (std::size_t k = 0; k < shapes.size(); ++k)
            if (static_cast<int>(levels.size()) - dropped >= shapes[k].parameters())
                if (auto fit = fit_terms(window, shapes[k]))
                    members_.push_back({std::move(*fit), static_cast<int>(k), {place}});
    }
}

/// The rows that are in a window of all widths.
TermRows OrderEnsemble::rows_from(const TermRows& rows, const std::vector<int>& place) const {
    std::vector<Index> chosen;
    for (Index r = 0; r < rows.size(); ++r) {
        bool inside = true;
        for (std::size_t i = 0; i < place.size(); ++i)
            inside = inside &&
                     level_of(levels_[i], rows.log_widths(r, static_cast<Index>(i))) >= place[i];
        if (inside)
            chosen.push_back(r);
    }
    return rows.subset(chosen);
}

void OrderEnsemble::fit_all_widths(const TermRows& rows) {
    std::vector<int> most;
    for (const auto& levels : levels_)
        most.push_back(most_dropped(levels.size()));
    const auto shapes = shapes_of(levels_.size());
    // Where the search from nothing ends in a false valley, that from another window's fit does
    // not.
    constexpr double far_better = 10;
    constexpr double to_rounding = 1e-7;
    constexpr int fewest_spare = 2; // rows: seven parameters follow any nine
    std::vector<std::optional<TermFit>> closest(
        shapes.size()); // of the widest window, if it can be
    const auto is_far_off = [&](const TermFit& fit, const TermFit& other) {
        return fit.scale > far_better * std::max(other.scale, to_rounding);
    };
    for (const auto& place : places_within(most)) {
        const auto window = rows_from(rows, place);
        std::optional<TermFit> plain;
        double least_scale = infinity; // of those with next terms of one kind
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const bool of_two_kinds = has_next_terms_of_two_kinds(shapes[k]);
            if (window.size() <= shapes[k].parameters() + (of_two_kinds ? fewest_spare : 0))
                continue;
            auto fit = fit_terms(window, shapes[k], plain ? &*plain : nullptr,
                                 closest[k] ? &*closest[k] : nullptr);
            if (!fit || !is_believable(*fit, window))
                continue;
            if (k == 0)
                plain = fit;
            if (!of_two_kinds)
                least_scale = std::min(least_scale, fit->scale);
            else if (fit->scale > std::max(least_scale, to_rounding))
                continue; // what fits no better with more parameters follows scatter
            if (!closest[k] || is_far_off(*closest[k], *fit))
                closest[k] = fit;
            members_.push_back({std::move(*fit), static_cast<int>(k), place});
        }
    }
    for (auto& member : members_) {
        const auto& best = *closest[static_cast<std::size_t>(member.family)];
        if (!is_far_off(member.fit, best))
            continue;
        const auto window = rows_from(rows, member.place);
        auto fit = fit_terms(window, best.shape, &member.fit, &best);
        if (fit && fit->scale < member.fit.scale && is_believable(*fit, window))
            member.fit = std::move(*fit);
    }
}

void OrderEnsemble::fit_each_alone(const TermRows& rows) {
    const auto shapes = shapes_of(1);
    for (Index i = 0; i < rows.widths(); ++i) {
        const auto& own = levels_[static_cast<std::size_t>(i)];
        for (const auto& place : places_within({most_dropped(own.size()), 3})) {
            std::vector<Index> chosen;
            for (Index r = 0; r < rows.size(); ++r) {
                bool inside = level_of(own, rows.log_widths(r, i)) >= place[0];
                for (Index j = 0; j < rows.widths(); ++j) {
                    const auto& other = levels_[static_cast<std::size_t>(j)];
                    if (j != i && place[1] > 0)
                        inside = inside &&
                                 level_of(other, rows.log_widths(r, j)) >=
                                     static_cast<int>(other.size()) - finest_levels[place[1] - 1];
                }
                if (inside)
                    chosen.push_back(r);
            }
            const auto window = rows.subset(chosen).along(i);
            for (std::size_t k = 0; k < shapes.size(); ++k)
                if (window.size() > shapes[k].parameters())
                    if (auto fit = fit_terms(window, shapes[k]))
                        members_.push_back({std::move(*fit),
                                            static_cast<int>(100 * (i + 1)) + static_cast<int>(k),
                                            place, i});
        }
    }
}

/// The greatest change of a number when its window changes by one level, on any axis. Where an axis
/// has no other window another model of the same window stands in, with the change of its own. None
/// where there is nothing to compare with.
std::optional<double> OrderEnsemble::change_of(const Numbers& numbers, int family,
                                               const std::vector<int>& place) const {
    const double value = numbers.at({family, place}).value;
    double change = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        bool compared = false;
        for (const int step : {-1, 1}) {
            auto beside = place;
            beside[i] += step;
            if (const auto found = numbers.find({family, beside}); found != numbers.end()) {
                change = std::max(change, stretch_[i] * std::abs(found->second.value - value));
                compared = true;
            }
        }
        if (compared)
            continue;
        // Of the leading terms alone the model with a next term in the width of this axis.
        const int leading = family - family % 100;
        const int axis = leading == 0 ? static_cast<int>(i) : 0;
        const int stand_in = family == leading ? leading + 1 + axis : leading;
        const auto found = numbers.find({stand_in, place});
        if (found == numbers.end())
            return std::nullopt;
        change = std::max(change, stretch_[i] * std::abs(found->second.value - value));
        if (family != leading) {
            const auto further = change_of(numbers, leading, place);
            if (!further)
                return std::nullopt;
            change = std::max(change, *further);
        }
    }
    return change;
}

/// The numbers of all members that have one, with Student's factor on their errors.
OrderEnsemble::Numbers OrderEnsemble::numbers_of(const Functional& number) const {
    Numbers numbers;
    for (const auto& member : members_)
        if (const auto one = number(member); one && std::isfinite(one->value))
            numbers[{member.family, member.place}] = {
                one->value,
                // A sequence's shortest windows are exact: where no scatter is known, all that is
                // known of them is their drift.
                member.fit.dof == 0 && levels_.size() == 1 && !(rows_.scatter > 0)
                    ? 0.0
                    : one->error * member.fit.student()};
    return numbers;
}

std::optional<OrderEnsemble::Mixture> OrderEnsemble::mix(const Functional& number) const {
    const Numbers numbers = numbers_of(number);
    struct Weighed {
        double value, error, change, weight;
    };
    std::vector<Weighed> all;
    double weights = 0;
    double mean = 0;
    const double hidden_drift = tuning_.hidden_drift * std::ranges::max(stretch_); // of all widths
    for (const auto& [where, one] : numbers) {
        auto change = change_of(numbers, where.first, where.second);
        // All of it, also where known scatter may have made it: it may as well hide some.
        if (change && rows_.scatter > 0)
            change = std::hypot(*change, hidden_drift * one.error);
        if (!change || !std::isfinite(std::hypot(one.error, *change)))
            continue;
        const double unit = std::hypot(one.error, *change) + tuning_.agreement;
        all.push_back({one.value, one.error, *change, 1 / (unit * unit)});
        weights += all.back().weight;
        mean += all.back().weight * one.value;
    }
    if (!(weights > 0))
        return std::nullopt;
    mean /= weights;
    double scatter = 0; // known, so that it needs no factor but that of 95 %
    double spread = 0;
    for (const auto& [value, error, change, weight] : all) {
        const double off = (value - mean) * (value - mean);
        const double own = error * error;
        scatter += rows_.scatter > 0 ? weight * own : 0;
        spread +=
            weight * (change * change + (rows_.scatter > 0 ? std::max(0.0, off - own) : off + own));
    }
    const double factor = levels_.size() == 1 ? sequence_factor() : grid_factor();
    return Mixture{mean, std::hypot(1.96 * std::sqrt(scatter / weights),
                                    factor * std::sqrt(spread / weights)) +
                             tuning_.narrowest};
}

double OrderEnsemble::sequence_factor() const {
    constexpr double fewest = 4.3;
    const auto& levels = levels_.front();
    auto count = static_cast<double>(levels.size());
    // Under known scatter levels closer than halved widths are not as many.
    if (rows_.scatter > 0)
        count = std::min(count, std::max(std::min(count, fewest),
                                         1 + (levels.front() - levels.back()) / std::log(2)));
    const double spare = count - 2;
    return tuning_.sequence * (1 + tuning_.few_levels / (spare * spare));
}

double OrderEnsemble::grid_factor() const {
    const bool few = std::ranges::any_of(
        levels_, [](const auto& levels) { return levels.size() == fewest_levels; });
    return tuning_.grid * (few ? tuning_.three_levels : 1.0) *
           (rows_.scatter > 0 ? tuning_.scattered : 1.0);
}

double OrderEnsemble::greatest_share(Index width) const {
    double share = 0;
    for (const auto& member : members_) {
        if (member.family != 0)
            continue;
        for (Index r = 0; r < rows_.size(); ++r)
            share = std::max(share, member.fit.term(width, rows_.log_widths(r, width)) /
                                        std::exp(rows_.log_errors[r]));
    }
    return share;
}

/// The order in windows that leave out ever more of the coarse levels, and its standard error: the
/// means over all members without next terms.
std::vector<FittedNumber> OrderEnsemble::order_by_window(Index width) const {
    std::map<int, std::pair<FittedNumber, int>> sums;
    for (const auto& member : members_)
        if (member.family == 0) {
            auto& [sum, count] = sums[member.place[static_cast<std::size_t>(width)]];
            const FittedNumber order = member.fit.order(width);
            sum.value += order.value;
            sum.error += order.error;
            ++count;
        }
    std::vector<FittedNumber> means;
    means.reserve(sums.size());
    for (const auto& [place, sum] : sums)
        means.push_back({sum.first.value / sum.second, sum.first.error / sum.second});
    return means;
}

/// Whether the order's last step is more than known scatter makes of an order that stands still;
/// where none is known, any is. One window is part of the other, so that the variance of the step
/// is the difference of theirs.
bool OrderEnsemble::may_be_a_step(const std::vector<FittedNumber>& windows) const {
    constexpr double deviations = 2;
    const auto& last = windows.back();
    const auto& before = windows[windows.size() - 2];
    const double variance = std::max(0.0, last.error * last.error - before.error * before.error);
    return !(rows_.scatter > 0) ||
           std::abs(last.value - before.value) > deviations * std::sqrt(variance);
}

/// Of a sequence: whether one model's order stands still over its windows, all but one, while that
/// of the leading term alone moves: then that model says what it moves to.
bool OrderEnsemble::is_explained() const {
    constexpr double still = 0.05; // over how far the leading term's order moves
    std::map<int, std::vector<double>> orders;
    for (const auto& member : members_)
        orders[member.family].push_back(member.fit.order(0).value);
    const auto range = [](std::vector<double> values, bool without_one) {
        std::sort(values.begin(), values.end());
        const std::size_t n = values.size();
        const double all = values.back() - values.front();
        return without_one ? std::min(values[n - 2] - values.front(), values.back() - values[1])
                           : all;
    };
    const double moved = range(orders[0], false);
    return std::any_of(orders.begin(), orders.end(), [&](const auto& family) {
        return family.first != 0 && family.second.size() > 2 &&
               range(family.second, true) < still * moved;
    });
}

/// Of a sequence: whether the order moves one way, and from each window to the next by more, or,
/// over five levels or more, by hardly less: a next term of h^½ has steps of 0.71 on halved widths.
/// What it goes to is then beyond what any window shows.
bool OrderEnsemble::runs_away(Index width) const {
    constexpr double hardly_less = 0.75;
    constexpr double least_of_many = 0.25; // of `narrowest`, where many steps go one way
    const auto means = order_by_window(width);
    if (rows_.widths() != 1 || means.size() < 3 || !may_be_a_step(means))
        return false;
    std::vector<double> ratios; // of consecutive steps
    for (std::size_t i = 2; i < means.size(); ++i)
        ratios.push_back((means[i].value - means[i - 1].value) /
                         (means[i - 1].value - means[i - 2].value));
    const double least = *std::min_element(ratios.begin(), ratios.end());
    if (!(least > 0))
        return false;
    const double last = std::abs(means.back().value - means[means.size() - 2].value);
    if (is_explained())
        return false;
    const bool slows_down = ratios.size() < 2 ||
                            std::min(ratios.back(), ratios[ratios.size() - 2]) <= hardly_less ||
                            last <= least_of_many * tuning_.narrowest;
    return (least > 1 && last > tuning_.narrowest) || !slows_down;
}

/// Of a grid: whether the order of the leading terms moves from the last window but one to the last
/// by more than half an interval may be, and what all models say is farther on by half as much:
/// that of exp(−1/h) goes on.
bool OrderEnsemble::leaps(Index width, double order) const {
    const auto means = order_by_window(width);
    if (rows_.widths() == 1 || means.size() < 2)
        return false;
    const double last = means.back().value;
    const double step = last - means[means.size() - 2].value;
    return std::abs(step) > tuning_.widest &&
           std::copysign(1.0, step) * (order - last) > tuning_.widest / 2;
}

std::string OrderEnsemble::motion(Index width) const {
    const auto means = order_by_window(width);
    if (means.size() < 2 || !may_be_a_step(means))
        return {};
    const double last = means.back().value;
    const double step = last - means[means.size() - 2].value;
    if (std::abs(step) < tuning_.narrowest || std::abs(last) > 20)
        return {};
    for (std::size_t i = 1; i < means.size(); ++i)
        if ((means[i].value - means[i - 1].value) * step <= 0)
            return {};
    return fmt::format("it {} over finer windows, to {:.2f}", step > 0 ? "rises" : "falls", last);
}

std::vector<OrderInterval> OrderEnsemble::orders() const {
    std::vector<OrderInterval> result(levels_.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        auto& order = result[i];
        if (!failure_.empty()) {
            order.status = failure_;
            continue;
        }
        const auto width = static_cast<Index>(i);
        order.share = rows_.widths() == 1 ? 1.0 : greatest_share(width);
        const auto mixture = mix([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
            if (member.along >= 0 && member.along != width)
                return std::nullopt;
            return member.fit.order(member.along < 0 ? width : 0);
        });
        if (mixture) {
            order.value = mixture->value;
            order.low = mixture->value - mixture->half;
            order.high = mixture->value + mixture->half;
        }
        order.determined = mixture && order.share >= tuning_.least_share &&
                           order.low > tuning_.narrowest && mixture->half <= tuning_.widest &&
                           !runs_away(width) && !leaps(width, order.value);
        if (!order.determined)
            order.status = status_of(width, order);
    }
    return result;
}

std::string OrderEnsemble::status_of(Index width, const OrderInterval& order) const {
    if (order.share < tuning_.least_share)
        return "hidden: its term is less than 15 % of every error";
    if (std::abs(order.value) <= 2 * tuning_.narrowest && order.half_width() <= tuning_.widest)
        return "the error stands still";
    if (order.high <= 0)
        return fmt::format("the error grows under refinement, order {:.2f}", order.value);
    const std::string moves = motion(width);
    return moves.empty() ? "models and windows do not agree" : moves;
}

int OrderEnsemble::place_of(Index width, double log_width) const {
    return level_of(levels_[static_cast<std::size_t>(width)], log_width);
}

bool OrderEnsemble::holds(const EnsembleMember& member, const std::vector<double>& widths) const {
    for (std::size_t i = 0; i < levels_.size(); ++i)
        if (place_of(static_cast<Index>(i), std::log(widths[i])) < member.place[i])
            return false;
    return true;
}

const EnsembleMember* OrderEnsemble::steadiest() const {
    std::vector<double> units(members_.size(), 0.0);
    for (Index i = 0; i < rows_.widths(); ++i) {
        const auto numbers = numbers_of([&](const EnsembleMember& member) {
            return member.family == 0 ? std::optional(member.fit.order(i)) : std::nullopt;
        });
        for (std::size_t k = 0; k < members_.size(); ++k) {
            const auto found = numbers.find({members_[k].family, members_[k].place});
            const auto change = found == numbers.end()
                                    ? std::nullopt
                                    : change_of(numbers, members_[k].family, members_[k].place);
            units[k] = change ? std::hypot(units[k], found->second.error, *change) : infinity;
        }
    }
    const EnsembleMember* best = nullptr;
    double least = infinity;
    for (std::size_t k = 0; k < members_.size(); ++k)
        if (members_[k].family == 0 && (best == nullptr || units[k] < least - tuning_.narrowest)) {
            best = &members_[k];
            least = units[k];
        }
    return best;
}

bool OrderEnsemble::has_logarithm() const {
    if (rows_.widths() != 1)
        return false;
    std::map<int, std::pair<double, double>> ranges; // of the order, over the windows of a family
    for (const auto& member : members_) {
        const double order = member.fit.order(0).value;
        auto& [low, high] = ranges.try_emplace(member.family, order, order).first->second;
        low = std::min(low, order);
        high = std::max(high, order);
    }
    // So much steadier than all others. Of 2000 sequences without one, of errors that scatter by 1
    // to 30 %, at most five look so with seven levels or more; with six, up to thirteen.
    constexpr double far = 10;
    constexpr std::size_t fewest_levels = 7;
    double others = infinity;
    for (const auto& [family, range] : ranges)
        if (family != logarithmic_family)
            others = std::min(others, range.second - range.first);
    const auto own = ranges.find(logarithmic_family);
    return own != ranges.end() && levels_.front().size() >= fewest_levels &&
           others > std::max(far * (own->second.second - own->second.first), tuning_.narrowest);
}

OrderInterval OrderEnsemble::forecast(const std::vector<double>& widths,
                                      bool against_reference) const {
    const Eigen::VectorXd log_widths =
        Eigen::Map<const Eigen::ArrayXd>(widths.data(), static_cast<Index>(widths.size())).log();
    OrderInterval result{.status = failure_};
    const auto mixture = mix([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
        if (member.along >= 0)
            return std::nullopt;
        return member.fit.log_error(log_widths, against_reference);
    });
    if (!mixture)
        return result;
    result.value = std::exp(mixture->value);
    result.low = std::exp(mixture->value - mixture->half);
    result.high = std::exp(mixture->value + mixture->half);
    result.determined = true;
    return result;
}

std::vector<OrderInterval> estimate_orders(std::span<const ErrorRow> rows,
                                           std::vector<double> reference,
                                           const OrderTuning& tuning) {
    return OrderEnsemble(rows, std::move(reference), tuning).orders();
}

} // namespace tvbeam
