#include "studies/orders/order_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace tvbeam {

namespace {

/// The means over all members without next terms, by how many coarse levels they leave out.
std::vector<FittedNumber> order_by_window(std::span<const EnsembleMember> members,
                                          Eigen::Index width) {
    std::map<int, std::pair<FittedNumber, int>> sums;
    for (const auto& member : members)
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

/// (ln h, p) in the middle of each two levels.
std::vector<std::pair<double, double>> orders_between(const std::vector<double>& log_widths,
                                                      const std::vector<double>& log_errors) {
    std::vector<std::pair<double, double>> result;
    for (std::size_t k = 1; k < log_widths.size(); ++k)
        result.emplace_back(std::midpoint(log_widths[k - 1], log_widths[k]),
                            (log_errors[k - 1] - log_errors[k]) /
                                (log_widths[k - 1] - log_widths[k]));
    return result;
}

} // namespace

OrderMotion::OrderMotion(const TermRows& rows, const std::vector<std::vector<double>>& levels,
                         std::span<const EnsembleMember> members, Eigen::Index width,
                         const OrderTuning& tuning)
    : rows_(rows), levels_(levels), members_(members), width_(width), tuning_(tuning),
      windows_(order_by_window(members, width)) {}

/// Whether the order's last step is more than known scatter makes of an order that stands still;
/// where none is known, any is. One window is part of the other, so that the variance of the step
/// is the difference of theirs.
bool OrderMotion::may_be_a_step() const {
    constexpr double deviations = 2;
    const auto& last = windows_.back();
    const auto& before = windows_[windows_.size() - 2];
    const double variance = std::max(0.0, last.error * last.error - before.error * before.error);
    return !(rows_.scatter > 0) ||
           std::abs(last.value - before.value) > deviations * std::sqrt(variance);
}

bool OrderMotion::is_explained() const {
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
bool OrderMotion::runs_away() const {
    constexpr double hardly_less = 0.75;
    constexpr double least_of_many = 0.25; // of `narrowest`, where many steps go one way
    if (rows_.widths() != 1 || windows_.size() < 3 || !may_be_a_step())
        return false;
    std::vector<double> ratios; // of consecutive steps
    for (std::size_t i = 2; i < windows_.size(); ++i)
        ratios.push_back((windows_[i].value - windows_[i - 1].value) /
                         (windows_[i - 1].value - windows_[i - 2].value));
    const double least = *std::min_element(ratios.begin(), ratios.end());
    if (!(least > 0))
        return false;
    const double last = std::abs(windows_.back().value - windows_[windows_.size() - 2].value);
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
bool OrderMotion::leaps(double order) const {
    if (rows_.widths() == 1 || windows_.size() < 2)
        return false;
    const double last = windows_.back().value;
    const double step = last - windows_[windows_.size() - 2].value;
    return std::abs(step) > tuning_.widest &&
           std::copysign(1.0, step) * (order - last) > tuning_.widest / 2;
}

/// The rows where all other widths are finest, coarse to fine, one a level.
std::vector<Eigen::Index> OrderMotion::finest_rows() const {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index r = 0; r < rows_.size(); ++r) {
        bool is_finest = true;
        for (Eigen::Index i = 0; i < rows_.widths(); ++i) {
            const auto& levels = levels_[static_cast<std::size_t>(i)];
            is_finest = is_finest && (i == width_ || level_of(levels, rows_.log_widths(r, i)) + 1 ==
                                                         static_cast<int>(levels.size()));
        }
        if (is_finest)
            rows.push_back(r);
    }
    std::ranges::sort(rows, std::greater<>(),
                      [&](Eigen::Index r) { return rows_.log_widths(r, width_); });
    const auto level = [&](Eigen::Index r) {
        return level_of(levels_[static_cast<std::size_t>(width_)], rows_.log_widths(r, width_));
    };
    const auto is_repeated = [&](Eigen::Index a, Eigen::Index b) { return level(a) == level(b); };
    rows.erase(std::unique(rows.begin(), rows.end(), is_repeated), rows.end());
    return rows;
}

/// The orders from each of these rows to the next, by what says the logarithm of a row's error.
std::vector<double>
OrderMotion::local_orders(const std::vector<Eigen::Index>& rows,
                          const std::function<double(Eigen::Index)>& log_error) const {
    std::vector<double> orders;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        orders.push_back(
            (log_error(rows[i]) - log_error(rows[i + 1])) /
            (rows_.log_widths(rows[i], width_) - rows_.log_widths(rows[i + 1], width_)));
    return orders;
}

/// The row that is coarser by a level in one width and like this one in all others.
std::optional<Eigen::Index> OrderMotion::coarser_by_a_level(Eigen::Index row,
                                                            Eigen::Index other) const {
    const auto level = [&](Eigen::Index r, Eigen::Index i) {
        return level_of(levels_[static_cast<std::size_t>(i)], rows_.log_widths(r, i));
    };
    for (Eigen::Index r = 0; r < rows_.size(); ++r) {
        bool is_beside = level(r, other) + 1 == level(row, other);
        for (Eigen::Index i = 0; i < rows_.widths(); ++i)
            is_beside = is_beside && (i == other || level(r, i) == level(row, i));
        if (is_beside)
            return r;
    }
    return std::nullopt;
}

/// Whether each of these rows has nearly the error of the one that is coarser by a level in another
/// width: what is left of the other terms is then less.
bool OrderMotion::others_change_nothing(const std::vector<Eigen::Index>& rows) const {
    for (Eigen::Index other = 0; other < rows_.widths(); ++other)
        for (const auto row : rows) {
            if (other == width_)
                continue;
            const auto coarser = coarser_by_a_level(row, other);
            if (!coarser || !(std::abs(rows_.log_errors[*coarser] - rows_.log_errors[row]) <=
                              tuning_.unchanged))
                return false;
        }
    return true;
}

/// Of a grid: whether leading terms follow all rows within this scatter of ln e: where they cancel
/// orders move as those of no power. Of orders that methods have, or of any.
bool OrderMotion::terms_follow(double within, bool of_usual_orders) const {
    return rows_.widths() > 1 && std::ranges::any_of(members_, [&](const EnsembleMember& member) {
               if (member.family != 0 || !member.is_of_all_rows() || !(member.fit.scale <= within))
                   return false;
               bool are_usual = true;
               for (Eigen::Index i = 0; i < rows_.widths(); ++i)
                   are_usual = are_usual && member.fit.order(i).value >= tuning_.least_order;
               return are_usual || !of_usual_orders;
           });
}

std::optional<double> OrderMotion::rises_past(double high) const {
    if (rows_.widths() == 1 || rows_.log_reference.size() > 0)
        return std::nullopt;
    const auto rows = finest_rows();
    const auto orders = local_orders(rows, [&](Eigen::Index r) { return rows_.log_errors[r]; });
    if (orders.size() < 2 || !others_change_nothing(rows))
        return std::nullopt;
    // Five levels show a constant, too, as of a reference that is not named.
    constexpr std::size_t of_five_levels = 4;
    constexpr double to_rounding = 1e-5;
    if (terms_follow(to_rounding, orders.size() < of_five_levels))
        return std::nullopt;
    for (std::size_t i = 1; i < orders.size(); ++i)
        if (!(orders[i] - orders[i - 1] > tuning_.narrowest))
            return std::nullopt;
    constexpr double deviations = 2;
    const double step =
        rows_.log_widths(rows[rows.size() - 2], width_) - rows_.log_widths(rows.back(), width_);
    const double least = tuning_.explained + deviations * std::sqrt(2.0) * rows_.scatter / step;
    return orders.back() - high > least ? std::optional(orders.back()) : std::nullopt;
}

std::vector<std::pair<double, double>> LevelErrors::orders() const {
    auto without = log_errors;
    for (std::size_t k = 0; k < without.size(); ++k)
        without[k] += std::log1p(-parts_of_others[k]);
    return orders_between(log_widths, without);
}

double LevelErrors::last_seen() const {
    return orders_between(log_widths, log_errors).back().second;
}

std::vector<double> LevelErrors::changes() const {
    const auto with = orders_between(log_widths, log_errors);
    const auto without = orders();
    std::vector<double> result;
    for (std::size_t k = 1; k < with.size(); ++k) {
        const double scale = std::log(2.0) / (with[k - 1].first - with[k].first);
        const double one = (with[k].second - with[k - 1].second) * scale;
        const double other = (without[k].second - without[k - 1].second) * scale;
        result.push_back(
            one * other > 0 ? std::copysign(std::min(std::abs(one), std::abs(other)), one) : 0.0);
    }
    return result;
}

double LevelErrors::noise() const {
    // What is taken off may be wrong by as much: the order of the other term is not known, and in a
    // norm terms of opposite sign do not take each other off. Of a part that is the same in all
    // errors no order changes.
    double step = std::numeric_limits<double>::infinity();
    double difference = 0;
    for (std::size_t k = 1; k < log_widths.size(); ++k) {
        step = std::min(step, log_widths[k - 1] - log_widths[k]);
        difference = std::max(difference, std::abs(parts_of_others[k] - parts_of_others[k - 1]));
    }
    return 2 * difference * std::log(2.0) / (step * step);
}

bool LevelErrors::turn() const {
    constexpr double far = 0.15; // set, as what follows, on half of 250 solutions of the beam
    const auto all = changes();
    const double last = all.back();
    const double before = all[all.size() - 2];
    return last * before < 0 && std::min(std::abs(last), std::abs(before)) > far + noise();
}

bool LevelErrors::leave(double low, double high) const {
    const auto all = changes();
    const double last = all.back();
    const double before = all[all.size() - 2];
    constexpr double least = 0.005;
    if (!(last * before > 0 && std::abs(last) > std::abs(before) &&
          std::abs(last) > std::max(least, noise())))
        return false;
    constexpr double fastest = 2.5; // of exp(−1/h) and before a zero it grows without bound
    const double growth = std::min(last / before, fastest);
    const double ahead = orders().back().second + last * (1 + growth + growth * growth);
    return ahead < low || ahead > high;
}

/// What other terms, of these orders, are of a row's error, as the next coarser step of each shows
/// it: b x^q changes by b x^q (r^q − 1). None where there is no such row.
std::optional<double> OrderMotion::part_of_others(Eigen::Index row,
                                                  const std::vector<double>& orders) const {
    double part = 0;
    for (Eigen::Index other = 0; other < rows_.widths(); ++other) {
        if (other == width_)
            continue;
        const auto coarser = coarser_by_a_level(row, other);
        if (!coarser)
            return std::nullopt;
        const double step = rows_.log_widths(*coarser, other) - rows_.log_widths(row, other);
        part += std::expm1(rows_.log_errors[*coarser] - rows_.log_errors[row]) /
                std::expm1(orders[static_cast<std::size_t>(other)] * step);
    }
    return part;
}

/// Of all widths, as far as methods have them: by the leading terms in the finest window.
std::vector<double> OrderMotion::orders_of_all() const {
    constexpr double least = 1;
    constexpr double greatest = 4;
    std::vector<double> orders;
    for (Eigen::Index i = 0; i < rows_.widths(); ++i) {
        const auto windows = order_by_window(members_, i);
        orders.push_back(windows.empty() ? least
                                         : std::clamp(windows.back().value, least, greatest));
    }
    return orders;
}

std::optional<LevelErrors> OrderMotion::levels_alone() const {
    constexpr std::size_t fewest = 4;
    const auto& levels = levels_[static_cast<std::size_t>(width_)];
    if (rows_.scatter > 0 || rows_.log_reference.size() > 0 || levels.size() < fewest ||
        (rows_.widths() == 1 && rows_.size() != static_cast<Eigen::Index>(levels.size())))
        return std::nullopt;
    LevelErrors found;
    const auto orders = orders_of_all();
    for (const Eigen::Index row : finest_rows()) {
        const auto part = part_of_others(row, orders);
        if (!part || !(std::abs(*part) < tuning_.others_left))
            return std::nullopt;
        found.log_widths.push_back(rows_.log_widths(row, width_));
        found.log_errors.push_back(rows_.log_errors[row]);
        found.parts_of_others.push_back(*part);
    }
    constexpr double to_rounding = 1e-5;
    constexpr double part_of_change = 0.05;
    constexpr std::size_t show_a_constant = 5;
    const auto is_above_a_constant = [&](const EnsembleMember& member) {
        return member.is_of_all_rows() && member.fit.scale <= to_rounding &&
               member.fit.shape.next[static_cast<std::size_t>(width_)] == TermShape::constant;
    };
    if (rows_.widths() > 1 && levels.size() >= show_a_constant &&
        std::ranges::any_of(members_, is_above_a_constant))
        return std::nullopt;
    if (found.log_widths.size() < fewest || terms_follow(to_rounding, false) ||
        terms_follow(part_of_change * std::abs(found.changes().back()), true))
        return std::nullopt;
    return found;
}

/// Whether the fit is one of terms that a method may have: without any bound on their orders next
/// terms follow exp(−1/h), too. Of leading terms alone one may be a constant that the error is
/// above or below.
bool OrderMotion::has_usual_terms(const EnsembleMember& member) const {
    int unusual = 0;
    for (Eigen::Index i = 0; i < rows_.widths(); ++i)
        if (const double order = member.fit.order(i).value;
            !(order >= tuning_.least_order && order <= tuning_.greatest_order))
            ++unusual;
    return unusual <= (member.family == 0 ? 1 : 0);
}

/// Of a grid: the greatest of its local orders where the other widths are finest, where they rise
/// up to it by ever more and no model of all levels does as much: that of exp(−1/h), or of levels
/// too coarse for a power to be seen. The other terms lower it, or are of opposite sign, which a
/// model then knows.
std::optional<double> OrderMotion::greatest_of_a_rise() const {
    constexpr double deviations = 2;
    if (rows_.widths() == 1)
        return std::nullopt;
    const auto rows = finest_rows();
    const auto step = [&](std::size_t i) {
        return rows_.log_widths(rows[i], width_) - rows_.log_widths(rows[i + 1], width_);
    };
    const auto orders = local_orders(rows, [&](Eigen::Index r) { return rows_.log_errors[r]; });
    const auto at = static_cast<std::size_t>(std::ranges::max_element(orders) - orders.begin());
    if (orders.empty() || at < 1)
        return std::nullopt;
    const double far = tuning_.widest * std::min(1.0, step(at) / std::log(2)); // on halved widths
    const double last = orders[at] - orders[at - 1];
    const double before = at > 1 ? orders[at - 1] - orders[at - 2] : far;
    if (!(before > 0 && last > std::max(at > 1 ? far : 2 * far, before)))
        return std::nullopt;
    const bool has_reference = rows_.log_reference.size() > 0;
    const bool is_modelled = std::ranges::any_of(members_, [&](const EnsembleMember& member) {
        if (member.along >= 0 || member.place[static_cast<std::size_t>(width_)] > 0 ||
            member.fit.shape.saturates || // its orders slow down as they rise
            !has_usual_terms(member) ||
            !(member.fit.next_part(width_, rows_.log_widths(rows.front(), width_)) >
              tuning_.least_left - 1))
            return false;
        const auto modelled = local_orders(rows, [&](Eigen::Index r) {
            return member.fit.log_error(rows_.log_widths.row(r).transpose(), has_reference).value;
        });
        for (std::size_t i = 0; i < orders.size(); ++i)
            if (!(std::abs(orders[i] - modelled[i]) <
                  tuning_.explained + deviations * std::sqrt(2.0) * rows_.scatter / step(i)))
                return false;
        return true;
    });
    return is_modelled ? std::nullopt : std::optional(orders[at]);
}

std::string OrderMotion::words() const {
    if (const auto greatest = greatest_of_a_rise())
        return fmt::format("it rises from level to level where the others are finest, to {:.2f}",
                           *greatest);
    const double step = step_over_windows();
    return step == 0 ? std::string()
                     : fmt::format("it {} over finer windows, to {:.2f}",
                                   step > 0 ? "rises" : "falls", windows_.back().value);
}

std::optional<std::pair<double, double>> OrderMotion::falls() const {
    return step_over_windows() < 0
               ? std::optional(std::pair(windows_.front().value, windows_.back().value))
               : std::nullopt;
}

/// The last step of the order from window to window, where all go its way; else 0.
double OrderMotion::step_over_windows() const {
    if (windows_.size() < 2 || !may_be_a_step())
        return 0;
    const double last = windows_.back().value;
    const double step = last - windows_[windows_.size() - 2].value;
    if (std::abs(step) < tuning_.narrowest || std::abs(last) > 20)
        return 0;
    for (std::size_t i = 1; i < windows_.size(); ++i)
        if ((windows_[i].value - windows_[i - 1].value) * step <= 0)
            return 0;
    return step;
}

} // namespace tvbeam
