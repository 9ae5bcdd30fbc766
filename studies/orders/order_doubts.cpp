// Why an order is not determined, or its interval wider than members agree (order_engine.hpp).
#include "studies/orders/order_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace tvbeam {

using Index = Eigen::Index;

namespace {

struct Steps {
    double size = 0;   ///< of the finest
    double order = 0;  ///< of the two finest
    double before = 0; ///< of the two before
};

/// Of the errors at the four finest of the widths whose logarithms are given, where these are
/// refined evenly and the error goes one way.
std::optional<Steps> finest_steps(const std::map<double, double>& errors) {
    constexpr double even = 0.01; // of the ratios
    std::array<double, 3> ratio{};
    std::array<double, 3> step{};
    auto row = errors.begin();
    for (std::size_t i = 0; i < step.size(); ++i) {
        const auto [width, error] = *row++;
        ratio.at(i) = row->first - width;
        step.at(i) = row->second - error;
    }
    for (std::size_t i = 0; i + 1 < step.size(); ++i)
        if (std::abs(ratio.at(i + 1) / ratio[0] - 1) > even || !(step.at(i + 1) / step.at(i) > 0))
            return std::nullopt;
    return Steps{std::abs(step[0]), std::log(step[1] / step[0]) / ratio[0],
                 std::log(step[2] / step[1]) / ratio[0]};
}

} // namespace

/// How far from an order that of a logarithm, or of a next term half an order on, is, where
/// scatter, or a width of a grid with three levels, leaves open whether there is one: of all models
/// of all rows with one that follow them about as closely as any. With its 95 % where the size of
/// that term is told from zero; at zero it and the order have nearly one derivative, and the
/// order's error says nothing.
double OrderEnsemble::distance_to_slow_terms(Index width, double order) const {
    if (!(rows_.scatter > 0) && (rows_.widths() == 1 || !has_width_of_few_levels()))
        return 0;
    const auto at = static_cast<std::size_t>(width);
    double closest = infinity;
    for (const auto& member : members_)
        if (member.is_of_all_rows())
            closest = std::min(closest, member.fit.scale);
    const double most =
        tuning_.about_as_closely * std::max({closest, rows_.scatter, least_scatter});
    double farthest = 0;
    for (const double slow : {TermShape::logarithm, 0.5}) {
        TermShape alone{std::vector<double>(levels_.size(), TermShape::none)};
        alone.next[at] = slow;
        // A logarithm that is lost without terms beside it (order_members.cpp) is none.
        if (std::ranges::none_of(members_, [&](const EnsembleMember& member) {
                return member.is_of_all_rows() && member.fit.shape == alone;
            }))
            continue;
        for (const auto& member : members_) {
            const TermFit& fit = member.fit;
            if (!member.is_of_all_rows() || fit.shape.next[at] != slow || fit.scale > most)
                continue;
            const auto [own, error] = fit.order(width);
            const auto size = fit.next(width);
            const bool is_told = std::abs(size.value) > 1.96 * size.error;
            farthest = std::max(farthest, std::abs(own - order) + (is_told ? 1.96 * error : 0.0) +
                                              tuning_.narrowest);
        }
    }
    return farthest;
}

/// How far from an order the one is that the orders of consecutive levels go to, where their
/// differences shrink more slowly than those of a next term half an order on: as those of h^1.8
/// beside h^2 do, which no model has. The slope of the order over ln h is taken to fall as h^gap,
/// the gap being what the last two slopes show, and no less than least_gap. Of orders that go one
/// way alone: others scatter, or have turned.
double OrderEnsemble::distance_to_close_terms(Index width, double order) const {
    const OrderMotion motion = motion_of(width);
    const auto levels = motion.levels_alone();
    if (!levels || (rows_.widths() == 1 && motion.is_explained()))
        return 0;
    // A next term an order or two on leaves a millionth of what the leading one leaves alone, a
    // close one a sixth.
    double leading = 0;
    double with_next = infinity;
    for (const auto& member : members_)
        if (member.is_of_all_rows() && member.family == 0)
            leading = member.fit.scale;
        else if (member.is_of_all_rows() &&
                 member.fit.shape.next[static_cast<std::size_t>(width)] >= 1)
            with_next = std::min(with_next, member.fit.scale);
    constexpr double all_but = 0.1;
    if (with_next < all_but * leading)
        return 0;
    const auto orders = levels->orders(); // coarse to fine
    constexpr double seen_on_grids = 0.1; // norms of two terms move orders, too
    const auto changes = levels->changes();
    const std::size_t n = orders.size();
    const auto by_order = [](const auto& one, const auto& other) {
        return one.second < other.second;
    };
    if ((!std::ranges::is_sorted(orders, by_order) &&
         !std::ranges::is_sorted(orders.rbegin(), orders.rend(), by_order)) ||
        !(std::abs(changes.back()) > levels->noise() + (rows_.widths() == 1 ? 0 : seen_on_grids)))
        return 0;
    const double last = changes[n - 2] / std::log(2.0);
    const double before = changes[n - 3] / std::log(2.0);
    const double step = (orders[n - 3].first - orders[n - 1].first) / 2;
    // Slopes of the order over ln h fall as h^gap, from the middle of two steps to that of the
    // next.
    constexpr double half_an_order = 0.5;
    constexpr double least_gap = 0.05;
    const double gap = std::max(std::log(before / last) / step, least_gap);
    if (!(gap < half_an_order) || !(before * last > 0))
        return 0;
    const double rest =
        last / gap * std::exp(-gap * (orders[n - 2].first - orders[n - 1].first) / 2);
    constexpr double margin = 1.5; // the gap shows too large where the two terms are as large
    return std::abs(orders[n - 1].second + margin * rest - order);
}

/// By the leading terms; where against a reference their search went on to no order at all
/// (order_members.cpp), by all models.
double OrderEnsemble::greatest_share(Index width) const {
    const auto counts = [&](const EnsembleMember& member) {
        return member.along < 0 &&
               (rows_.log_reference.size() == 0 || std::isfinite(member.fit.order(width).error));
    };
    const bool by_leading = std::ranges::any_of(members_, [&](const EnsembleMember& member) {
        return member.family == 0 && counts(member);
    });
    double share = 0;
    for (const auto& member : members_)
        if (counts(member) && (member.family == 0 || !by_leading))
            share = std::max(share, share_of_errors(member.fit, width, rows_));
    return share;
}

/// Whether a model of all rows follows them: of what none follows windows say this and that.
bool OrderEnsemble::is_followed() const {
    constexpr double deviations = 3;
    return rows_.widths() == 1 || std::ranges::any_of(members_, [&](const EnsembleMember& member) {
               return member.is_of_all_rows() &&
                      member.fit.scale <= std::max(tuning_.followed, deviations * rows_.scatter);
           });
}

/// Whether another width's term stands still in a fit and is this part of an error.
bool OrderEnsemble::has_constant_beside(const EnsembleMember& member, Index width,
                                        double share) const {
    for (Index i = 0; i < rows_.widths(); ++i)
        if (i != width && std::abs(member.fit.order(i).value) < tuning_.constant &&
            share_of_errors(member.fit, i, rows_) >= share)
            return true;
    return false;
}

/// Whether a next term's order in a width of three levels goes with a constant that is seen. Three
/// levels do not tell it from a next term, and so many models have one that they outweigh those
/// that do not. Against a reference, which has it, too, there is none.
bool OrderEnsemble::leans_on_a_constant(const EnsembleMember& member, Index width) const {
    return member.along < 0 && member.family != 0 && rows_.log_reference.size() == 0 &&
           levels_[static_cast<std::size_t>(width)].size() == fewest_levels &&
           has_constant_beside(member, width, tuning_.seen);
}

/// Whether what a model of one width alone has for its leading term stands still, and is what the
/// others' terms leave: where models of all widths follow all rows, those show what is whose. Of 3
/// h^2 + dt on 8 × 8 levels the order 0 of h alone had made 1.990 ± 0.209 of 2.000 ± 0.014.
bool OrderEnsemble::is_of_the_others(const EnsembleMember& member) const {
    const auto shows_all_terms = [&](const EnsembleMember& all) {
        if (!all.is_of_all_rows())
            return false;
        double least = infinity; // of the terms: what follows the others alone says nothing of it
        for (Index i = 0; i < rows_.widths(); ++i)
            least = std::min(least, mean_share_of_errors(all.fit, i, rows_));
        return all.fit.scale <= least * (all.family == 0 ? tuning_.followed_by_leading_terms
                                                         : tuning_.followed_to_rounding);
    };
    return member.along >= 0 && std::abs(member.fit.order(0).value) < tuning_.constant &&
           std::ranges::any_of(members_, shows_all_terms);
}

/// Whether another order may follow the levels of a width as well, with another correlation between
/// it and a constant that is most of the error: four levels have no more to say than these two, a
/// size and the constant. Of made-up h^p (1 + c h) + f on four levels, with any correlation, 73 of
/// 762 determined orders were wrong, most of them of p = 1; of those that are left 21 of 546 are. A
/// model that another of the same window refutes is none that follows them.
bool OrderEnsemble::is_ambiguous(Index width) const {
    constexpr std::size_t numbers = 4;
    constexpr double most_of_it = 0.5;
    if (rows_.widths() == 1 || rows_.log_reference.size() > 0 ||
        levels_[static_cast<std::size_t>(width)].size() > numbers)
        return false;
    const auto is_refuted = [&](const EnsembleMember& member) {
        return std::ranges::any_of(members_, [&](const EnsembleMember& other) {
            return other.along < 0 && other.place == member.place &&
                   is_far_worse(member.fit, other.fit);
        });
    };
    return std::ranges::any_of(members_, [&](const EnsembleMember& member) {
        return member.family == 0 && member.along < 0 &&
               has_constant_beside(member, width, most_of_it) && !is_refuted(member);
    });
}

/// Whether a steep order is seen at three levels: two show how the error falls between them, and
/// not that it falls so again. A smaller part of the error than this is not seen, however well
/// models follow it: those of exp(−1/h) do, too.
bool OrderEnsemble::is_seen_as_a_power(Index width, const OrderInterval& order) const {
    if (!(order.value > tuning_.steep) || rows_.widths() == 1)
        return true;
    const auto& levels = levels_[static_cast<std::size_t>(width)];
    for (const auto& member : members_) {
        if (member.family != 0 ||
            std::abs(member.fit.order(width).value - order.value) > tuning_.widest)
            continue;
        std::vector<bool> seen(levels.size(), false);
        for (Index r = 0; r < rows_.size(); ++r) {
            const double log_width = rows_.log_widths(r, width);
            const int level = level_of(levels, log_width);
            if (level >= member.place[static_cast<std::size_t>(width)] &&
                member.fit.measured_term(width, log_width) >=
                    tuning_.seen * std::exp(rows_.log_errors[r]))
                seen[static_cast<std::size_t>(level)] = true;
        }
        if (std::ranges::count(seen, true) >= static_cast<int>(fewest_levels))
            return true;
    }
    return false;
}

/// By how much the order between two levels changes from one pair to the next, where in the last
/// pairs of exact errors (of a grid where the others are finest) it changes by more than in those
/// before: of a power with a next term it changes less and less. Of |h − 30.45 h²|, next to where
/// it cancels, pairs have 2.1, 2.2, 2.6 and then 5.2, and models 1.70 ± 0.32.
std::optional<double> OrderEnsemble::drifts_away(Index width) const {
    constexpr std::size_t last_ones = 2;
    constexpr double little = 0.3; // on halved widths
    const auto levels = levels_alone(width);
    if (!levels)
        return std::nullopt;
    auto changes = levels->changes();
    std::ranges::reverse(changes);
    for (std::size_t k = 0; k < last_ones && k + 1 < changes.size(); ++k)
        if (std::abs(changes[k]) > little + levels->noise() &&
            std::abs(changes[k]) > std::abs(changes[k + 1]))
            return std::abs(changes[k]);
    return std::nullopt;
}

/// OrderMotion::levels_alone(), where nothing shows that they scatter.
std::optional<LevelErrors> OrderEnsemble::levels_alone(Index width) const {
    return scatters_ || !std::isfinite(tuning_.contradicted) ? std::nullopt
                                                             : motion_of(width).levels_alone();
}

/// How the order moves from level to level, where that says that it is not known; or empty. That a
/// sequence moves on its windows show (OrderMotion::goes_on).
std::string OrderEnsemble::motion_between_levels(Index width, const OrderInterval& order) const {
    const auto levels = levels_alone(width);
    if (!levels)
        return {};
    const std::string where = rows_.widths() == 1 ? "" : " where the others are finest";
    const double last = levels->last_seen();
    if (levels->turn())
        return fmt::format("from level to level{} it turns, and is {:.2f} at the finest", where,
                           last);
    return rows_.widths() > 1 && levels->leave(order.low, order.high)
               ? fmt::format("from level to level{} it moves more and more, to {:.2f}", where, last)
               : std::string();
}

/// The order of the steps between errors along the lines of a grid on which one width alone is
/// refined, at the finest of its levels, where all lines have nearly one, and steps of other sizes:
/// those of a sum are the same on all lines, whatever stands in it. Its error: how far it differs
/// from line to line, and from the level before.
std::optional<FittedNumber> OrderEnsemble::order_of_steps(Index width) const {
    constexpr std::size_t fewest_lines = 3;
    constexpr double nearly = 0.3; // of an order
    constexpr double the_same = 1.1;
    std::map<std::vector<int>, std::map<double, double>> lines; // ln width, error
    const double unit = rows_.log_errors.maxCoeff();
    for (Index r = 0; r < rows_.size(); ++r) {
        std::vector<int> others;
        for (Index i = 0; i < rows_.widths(); ++i)
            others.push_back(i == width ? 0 : place_of(i, rows_.log_widths(r, i)));
        lines[others][rows_.log_widths(r, width)] = std::exp(rows_.log_errors[r] - unit);
    }
    std::vector<double> orders;
    std::vector<double> sizes;
    double drift = 0;
    for (const auto& [others, line] : lines) {
        if (line.size() < 4 || line.begin()->first > rows_.log_widths.col(width).minCoeff())
            continue;
        const auto steps = finest_steps(line);
        if (!steps)
            return std::nullopt;
        orders.push_back(steps->order);
        sizes.push_back(steps->size);
        drift = std::max(drift, std::abs(steps->order - steps->before));
    }
    if (orders.size() < fewest_lines)
        return std::nullopt;
    const auto [least, greatest] = std::ranges::minmax(orders);
    const auto [small, large] = std::ranges::minmax(sizes);
    if (greatest - least > nearly || large < the_same * small)
        return std::nullopt;
    return FittedNumber{(least + greatest) / 2, greatest - least + drift};
}

/// Whether what the lines of a grid show speaks against terms of one width each, in words. Two
/// terms that are at right angles have steps of twice the order where the other one dominates.
/// Against a reference, which has a part of each, steps are as they would be: it says nothing.
std::string OrderEnsemble::steps_contradict(const std::vector<OrderInterval>& orders) const {
    constexpr double to_rounding = 1e-6;
    if (rows_.widths() != 2 || rows_.log_reference.size() > 0 ||
        std::ranges::any_of(members_, [&](const EnsembleMember& member) {
            return member.is_of_all_rows() &&
                   member.fit.scale <= std::max(to_rounding, 3 * rows_.scatter);
        }))
        return {};
    for (Index i = 0; i < 2; ++i) {
        const OrderInterval& order = orders[static_cast<std::size_t>(i)];
        const auto seen = order.determined ? order_of_steps(i) : std::nullopt;
        if (!seen)
            continue;
        const double margin = 2 * tuning_.narrowest + 2 * seen->error;
        if (std::max(order.low - seen->value, seen->value - order.high) > margin &&
            std::abs(seen->value - 2 * order.value) > margin)
            return fmt::format("along lines of the grid the errors step with order {:.2f}, which "
                               "models of a term in each width do not have: a term may depend on "
                               "both",
                               seen->value);
    }
    return {};
}

bool OrderEnsemble::is_settled(Index width, const OrderInterval& order) const {
    const OrderMotion motion = motion_of(width);
    return !drifts_away(width) && !motion.goes_on(order.value) && !motion.rises_past(order.high) &&
           motion_between_levels(width, order).empty() && is_followed() && !is_ambiguous(width) &&
           is_seen_as_a_power(width, order);
}

std::string OrderEnsemble::status_of(Index width, const OrderInterval& order) const {
    if (rows_.widths() > 1 && std::ranges::none_of(members_, [](const EnsembleMember& member) {
            return member.along < 0;
        }))
        return fmt::format("no model of all {} widths follows so few rows", rows_.widths());
    if (order.share < tuning_.least_share)
        return "hidden: its term is less than 15 % of every error";
    if (stands_still() || (rows_.widths() > 1 && is_near_zero(order)))
        return "the error stands still";
    if (is_near_zero(order))
        return "the error levels off";
    if (order.high <= 0)
        return fmt::format("the error grows under refinement, order {:.2f}", order.value);
    if (is_ambiguous(width))
        return fmt::format("beside a constant {} levels have more than one",
                           levels_[static_cast<std::size_t>(width)].size());
    std::string moves = motion_of(width).words();
    if (const auto last = motion_of(width).rises_past(order.high))
        moves = fmt::format("it rises from level to level where the others are finest, to {:.2f}",
                            *last);
    if (const auto change = moves.empty() ? drifts_away(width) : std::nullopt)
        return fmt::format("between levels it changes by {:.2f} at the finest, more than before",
                           *change);
    if (moves.empty())
        moves = motion_between_levels(width, order);
    if (moves.empty() && !is_seen_as_a_power(width, order))
        return fmt::format("no window shows an order of {:.1f} at three levels", order.value);
    if (!moves.empty())
        return moves;
    return is_followed() ? "models and windows do not agree" : "no model follows all rows";
}

bool OrderEnsemble::is_near_zero(const OrderInterval& order) const {
    return std::abs(order.value) <= 2 * tuning_.narrowest && order.half_width() <= tuning_.widest;
}

bool OrderEnsemble::stands_still() const {
    const auto range = [](const Eigen::VectorXd& logs) {
        return logs.maxCoeff() - logs.minCoeff();
    };
    return rows_.widths() == 1 &&
           range(rows_.log_errors) <= 2 * tuning_.narrowest * range(rows_.log_widths.col(0));
}

} // namespace tvbeam
