#include "studies/orders/order_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tvbeam {

namespace {

using Index = Eigen::Index;

/// What is left of a drift after one level, over that on halved widths: of a next term half an
/// order away, which falls by r^(-1/2) from level to level, Σ r^(-k/2) = 1/(1 - r^(-1/2)). 1 on
/// coarser ladders.
double drift_left(const std::vector<double>& levels) {
    const double step = (levels.front() - levels.back()) / static_cast<double>(levels.size() - 1);
    return std::max(1.0, (1 - std::sqrt(0.5)) / (1 - std::exp(-step / 2)));
}

/// Rows as usable_rows has them, with the reference.
TermRows rows_of(std::span<const ErrorRow> given, const std::vector<double>& reference,
                 std::size_t most_rows) {
    TermRows rows = usable_rows(given, most_rows);
    if (!reference.empty())
        rows.log_reference =
            Eigen::Map<const Eigen::ArrayXd>(reference.data(), static_cast<Index>(reference.size()))
                .log();
    return rows;
}

bool is_of_all_rows(const EnsembleMember& member) {
    return member.along < 0 &&
           std::ranges::all_of(member.place, [](int dropped) { return dropped == 0; });
}

} // namespace

OrderEnsemble::OrderEnsemble(std::span<const ErrorRow> rows, const std::vector<double>& reference,
                             const OrderTuning& tuning)
    : OrderEnsemble(rows_of(rows, reference, tuning.most_rows), tuning) {}

OrderEnsemble::OrderEnsemble(TermRows rows, const OrderTuning& tuning, bool may_scatter)
    : tuning_(tuning), rows_(std::move(rows)) {
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
    members_ = fit_members(rows_, levels_);
    scatters_ = rows_.scatter > 0 || residuals_scatter();
    // Scatter hides from the models with a next term what they would say of it.
    // Three levels make intervals as wide as that already.
    for (const auto& levels : levels_)
        stretch_.push_back(scatters_ && levels.size() > fewest_levels ? drift_left(levels) : 1.0);
    if (const double shown = may_scatter ? unstated_scatter() : 0; shown > rows_.scatter) {
        TermRows scattered = rows_;
        scattered.scatter = shown;
        scattered_.reset(new OrderEnsemble(std::move(scattered), tuning_, false));
    }
    if (rows_.in_squares < 0)
        for (Index i = 0; i < rows_.log_reference.size(); ++i)
            if (!std::isnan(rows_.log_reference[i])) {
                TermRows other = rows_;
                other.in_squares = i;
                in_squares_.emplace_back(new OrderEnsemble(std::move(other), tuning_, may_scatter));
            }
    const auto moving = moving_widths(rows_, tuning_.idle);
    if (moving.empty() || std::ssize(moving) == rows_.widths())
        return;
    // What these do not determine, they may with a constant in the place of the idle width.
    const OrderEnsemble without(with_widths(rows_, moving), tuning_);
    if (std::ranges::all_of(without.orders(), &OrderInterval::determined)) {
        moving_widths_ = moving;
        moving_ = std::make_shared<const OrderEnsemble>(without);
    }
}

/// Whether rows of a grid that nothing is said of scatter: all of them leave some, and no window
/// leaves far less. What the models lack falls from window to window with the widths.
bool OrderEnsemble::residuals_scatter() const {
    if (rows_.widths() == 1 || rows_.log_reference.size() > 0)
        return false;
    constexpr int fewest_spare = 3; // rows beyond the parameters: fewer are followed by chance
    double of_windows = infinity;
    double of_all = infinity;
    for (const auto& member : members_) {
        if (member.along < 0 && member.fit.dof >= fewest_spare)
            of_windows = std::min(of_windows, member.fit.scale);
        if (is_of_all_rows(member))
            of_all = std::min(of_all, member.fit.scale);
    }
    return std::isfinite(of_windows) && of_windows > tuning_.least_seen_scatter &&
           of_all <= tuning_.as_in_windows * of_windows;
}

/// Of a sequence of close levels whose residuals are far more than what is known of its scatter:
/// the least that any window shows, with Student's factor. What the models lack falls from window
/// to window with the width. 0 where there is nothing to say.
double OrderEnsemble::unstated_scatter() const {
    constexpr double close = 1.5; // a ratio of about 1.5 or less
    if (rows_.widths() > 1 || levels_.front().size() == fewest_levels ||
        !std::isfinite(tuning_.contradicted) || drift_left(levels_.front()) < close)
        return 0;
    constexpr int fewest_spare = 2; // in a window: one residual is small by chance
    double shown = infinity;
    for (const auto& member : members_) {
        const TermFit& fit = member.fit;
        const bool is_of_all = is_of_all_rows(member);
        if (is_of_all && fit.dof > 0 &&
            fit.scale <= std::max(tuning_.contradicted * rows_.scatter, least_scatter))
            return 0;
        if (fit.dof >= (is_of_all ? 1 : fewest_spare))
            shown = std::min(shown, fit.scale * student_over_normal(fit.dof));
    }
    return std::isfinite(shown) ? shown : 0;
}

std::optional<Index> OrderEnsemble::place_among_moving(Index width) const {
    if (!moving_)
        return width;
    const auto found = std::ranges::find(moving_widths_, width);
    return found == moving_widths_.end() ? std::nullopt
                                         : std::optional(found - moving_widths_.begin());
}

/// The model that differs from a family's in the next term of one width alone: with one for none,
/// without for any. The leading terms where there is no such model, and for models of one width.
int OrderEnsemble::model_beside(int family, Index width) const {
    const int leading = family - family % families_of_a_width;
    if (family == leading)
        return leading + 1 + (leading == 0 ? static_cast<int>(width) : 0);
    if (leading > 0 || rows_.widths() == 1)
        return leading;
    const auto of_family = std::ranges::find(members_, family, &EnsembleMember::family);
    TermShape shape = of_family->fit.shape;
    double& next = shape.next[static_cast<std::size_t>(width)];
    next = next == TermShape::none ? 1.0 : TermShape::none;
    const auto beside = std::ranges::find_if(members_, [&](const EnsembleMember& member) {
        return member.along < 0 && member.fit.shape == shape;
    });
    return beside == members_.end() ? leading : beside->family;
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
        const int leading = family - family % families_of_a_width;
        const int stand_in = model_beside(family, static_cast<Index>(i));
        const auto found = numbers.find({stand_in, place});
        if (found == numbers.end())
            return std::nullopt;
        change = std::max(change, stretch_[i] * std::abs(found->second.value - value));
        if (stand_in == leading) {
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
    const auto own = mix_of_members(number);
    if (in_squares_.empty())
        return own;
    std::vector<Mixture> all;
    if (own)
        all.push_back(*own);
    for (const auto& other : in_squares_)
        if (const auto one = other->mix(number))
            all.push_back(*one);
    return together(std::move(all));
}

/// Of what takes off a reference's error in one way or another. On three levels models agree by
/// chance, and say nothing of which is right.
std::optional<OrderEnsemble::Mixture> OrderEnsemble::together(std::vector<Mixture> all) const {
    const bool may_choose = !has_width_of_few_levels();
    const auto unit_of = [&](const Mixture& one) {
        return may_choose ? one.half - tuning_.narrowest + least_scatter : 1.0;
    };
    double least = infinity;
    for (const auto& one : all)
        least = std::min(least, unit_of(one));
    std::erase_if(all, [&](const Mixture& one) {
        return !(unit_of(one) <= tuning_.drifts_from_reference * least);
    });
    double weights = 0;
    double mean = 0;
    for (const auto& one : all) {
        const double weight = 1 / (unit_of(one) * unit_of(one));
        weights += weight;
        mean += weight * one.value;
    }
    if (!(weights > 0))
        return std::nullopt;
    mean /= weights;
    double square = 0;
    for (const auto& one : all)
        square += ((one.value - mean) * (one.value - mean) + one.half * one.half) /
                  (unit_of(one) * unit_of(one));
    return Mixture{mean, std::sqrt(square / weights)};
}

std::optional<OrderEnsemble::Mixture>
OrderEnsemble::mix_of_members(const Functional& number) const {
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
        const double part = 1 / (1 + std::pow(unit / tuning_.says_nothing, 2));
        all.push_back({one.value, one.error, *change, part / (unit * unit)});
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
    const double half =
        std::hypot(1.96 * std::sqrt(scatter / weights), factor * std::sqrt(spread / weights)) +
        tuning_.narrowest;
    if (!scattered_)
        return Mixture{mean, half};
    const auto other = scattered_->mix(number);
    if (!other)
        return std::nullopt;
    return Mixture{mean, std::max(half, std::abs(other->value - mean) + other->half)};
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
    return tuning_.grid * (has_width_of_few_levels() ? tuning_.three_levels : 1.0) *
           (scatters_ ? tuning_.scattered : 1.0);
}

bool OrderEnsemble::has_width_of_few_levels() const {
    return std::ranges::any_of(levels_,
                               [](const auto& levels) { return levels.size() == fewest_levels; });
}

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
        if (is_of_all_rows(member))
            closest = std::min(closest, member.fit.scale);
    const double most =
        tuning_.about_as_closely * std::max({closest, rows_.scatter, least_scatter});
    double farthest = 0;
    for (const double slow : {TermShape::logarithm, 0.5}) {
        TermShape alone{std::vector<double>(levels_.size(), TermShape::none)};
        alone.next[at] = slow;
        // A logarithm that is lost without terms beside it (order_members.cpp) is none.
        if (std::ranges::none_of(members_, [&](const EnsembleMember& member) {
                return is_of_all_rows(member) && member.fit.shape == alone;
            }))
            continue;
        for (const auto& member : members_) {
            const TermFit& fit = member.fit;
            if (!is_of_all_rows(member) || fit.shape.next[at] != slow || fit.scale > most)
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
double OrderEnsemble::distance_to_close_terms(double order) const {
    constexpr std::size_t fewest = 4; // levels: two differences of orders
    if (rows_.widths() != 1 || rows_.scatter > 0 || rows_.log_reference.size() > 0 ||
        rows_.size() != static_cast<Index>(levels_.front().size()) ||
        levels_.front().size() < fewest || motion_of(0).is_explained())
        return 0;
    // A next term an order or two on leaves a millionth of what the leading one leaves alone, a
    // close one a sixth.
    double leading = 0;
    double with_next = infinity;
    for (const auto& member : members_)
        if (is_of_all_rows(member) && member.family == 0)
            leading = member.fit.scale;
        else if (is_of_all_rows(member) && member.fit.shape.next.front() >= 1)
            with_next = std::min(with_next, member.fit.scale);
    constexpr double all_but = 0.1;
    if (with_next < all_but * leading)
        return 0;
    std::vector<std::pair<double, double>> rows; // ln h and ln e, coarse to fine
    for (Index r = 0; r < rows_.size(); ++r)
        rows.emplace_back(rows_.log_widths(r, 0), rows_.log_errors[r]);
    std::ranges::sort(rows, std::greater<>());
    std::vector<double> orders, places;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        orders.push_back((rows[r - 1].second - rows[r].second) /
                         (rows[r - 1].first - rows[r].first));
        places.push_back((rows[r - 1].first + rows[r].first) / 2);
    }
    const std::size_t n = orders.size();
    if (!std::ranges::is_sorted(orders) && !std::ranges::is_sorted(orders, std::greater<>()))
        return 0;
    const double last = (orders[n - 1] - orders[n - 2]) / (places[n - 2] - places[n - 1]);
    const double before = (orders[n - 2] - orders[n - 3]) / (places[n - 3] - places[n - 2]);
    const double step = (places[n - 3] - places[n - 1]) / 2;
    // Slopes of the order over ln h fall as h^gap, from the middle of two steps to that of the
    // next.
    constexpr double half_an_order = 0.5;
    constexpr double least_gap = 0.05;
    const double gap = std::max(std::log(before / last) / step, least_gap);
    if (!(gap < half_an_order))
        return 0;
    const double rest = last / gap * std::exp(-gap * (places[n - 2] - places[n - 1]) / 2);
    constexpr double margin = 1.5; // the gap shows too large where the two terms are as large
    return std::abs(orders[n - 1] + margin * rest - order);
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
               return is_of_all_rows(member) &&
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

/// Whether another order may follow the levels of a width as well, with another correlation between
/// it and a constant that is most of the error: four levels have no more to say than these two, a
/// size and the constant. Of h^p + f on four levels 64 of 116 of the orders 3 and 4 were wrong, as
/// low as 1.6, and none of order 1.
bool OrderEnsemble::is_ambiguous(Index width) const {
    constexpr std::size_t numbers = 4;
    constexpr double most_of_it = 0.5;
    constexpr double single = 1; // orders up to this
    if (rows_.widths() == 1 || rows_.log_reference.size() > 0 ||
        levels_[static_cast<std::size_t>(width)].size() > numbers)
        return false;
    return std::ranges::any_of(members_, [&](const EnsembleMember& member) {
        return member.family == 0 && member.along < 0 &&
               member.fit.order(width).value > single + tuning_.narrowest &&
               has_constant_beside(member, width, most_of_it);
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

OrderMotion OrderEnsemble::motion_of(Index width) const {
    return {rows_, levels_, members_, width, tuning_};
}

std::vector<OrderInterval> OrderEnsemble::orders() const {
    std::vector<OrderInterval> result(levels_.size());
    if (moving_) {
        constexpr double printed_step = 3.5; // of rounding, over its standard deviation: √12
        const auto moving = moving_->orders();
        for (std::size_t i = 0; i < result.size(); ++i)
            if (const auto place = place_among_moving(static_cast<Index>(i)))
                result[i] = moving[static_cast<std::size_t>(*place)];
            else
                result[i].status =
                    fmt::format("it changes no error by more than {:.1g} of it",
                                std::max(tuning_.idle, printed_step * rows_.scatter));
        return result;
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        auto& order = result[i];
        if (!failure_.empty()) {
            order.status = failure_;
            continue;
        }
        const auto width = static_cast<Index>(i);
        order.share = rows_.widths() == 1 ? 1.0 : greatest_share(width);
        const auto mixture = mix([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
            if ((member.along >= 0 && member.along != width) || leans_on_a_constant(member, width))
                return std::nullopt;
            return member.fit.order(member.along < 0 ? width : 0);
        });
        if (mixture) {
            const double half =
                std::max({mixture->half, distance_to_slow_terms(width, mixture->value),
                          distance_to_close_terms(mixture->value)});
            order.value = mixture->value;
            order.low = mixture->value - half;
            order.high = mixture->value + half;
        }
        order.determined =
            mixture && order.share >= tuning_.least_share && order.low > tuning_.narrowest &&
            order.half_width() <= tuning_.widest &&
            (is_settled(width, order) || std::ranges::any_of(in_squares_, [&](const auto& other) {
                 return other->is_settled(width, order);
             }));
        if (!order.determined) {
            order.status = status_of(width, order);
            order.falls = motion_of(width).falls();
        }
    }
    return result;
}

bool OrderEnsemble::is_settled(Index width, const OrderInterval& order) const {
    return !motion_of(width).goes_on(order.value) && is_followed() && !is_ambiguous(width) &&
           is_seen_as_a_power(width, order);
}

std::string OrderEnsemble::status_of(Index width, const OrderInterval& order) const {
    if (order.share < tuning_.least_share)
        return "hidden: its term is less than 15 % of every error";
    if ((std::abs(order.value) <= 2 * tuning_.narrowest && order.half_width() <= tuning_.widest) ||
        stands_still())
        return "the error stands still";
    if (order.high <= 0)
        return fmt::format("the error grows under refinement, order {:.2f}", order.value);
    if (is_ambiguous(width))
        return fmt::format("beside a constant {} levels have more than one",
                           levels_[static_cast<std::size_t>(width)].size());
    std::string moves = motion_of(width).words();
    if (moves.empty() && !is_seen_as_a_power(width, order))
        return fmt::format("no window shows an order of {:.1f} at three levels", order.value);
    if (!moves.empty())
        return moves;
    return is_followed() ? "models and windows do not agree" : "no model follows all rows";
}

bool OrderEnsemble::stands_still() const {
    const auto range = [](const Eigen::VectorXd& logs) {
        return logs.maxCoeff() - logs.minCoeff();
    };
    return rows_.widths() == 1 &&
           range(rows_.log_errors) <= 2 * tuning_.narrowest * range(rows_.log_widths.col(0));
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

OrderInterval OrderEnsemble::mix_logarithms(const Functional& logarithm) const {
    OrderInterval result{.status = failure_};
    if (const auto mixture = mix(logarithm)) {
        result.value = std::exp(mixture->value);
        result.low = std::exp(mixture->value - mixture->half);
        result.high = std::exp(mixture->value + mixture->half);
        result.determined = true;
    }
    return result;
}

OrderInterval OrderEnsemble::forecast(const std::vector<double>& widths,
                                      bool against_reference) const {
    const Eigen::VectorXd log_widths =
        Eigen::Map<const Eigen::ArrayXd>(widths.data(), static_cast<Index>(widths.size())).log();
    return mix_logarithms([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
        if (member.along >= 0)
            return std::nullopt;
        return member.fit.log_error(log_widths, against_reference);
    });
}

OrderInterval OrderEnsemble::size(Index width, const OrderInterval& order) const {
    OrderInterval size =
        mix_logarithms([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
            if (member.along >= 0 ||
                member.fit.shape.next[static_cast<std::size_t>(width)] == TermShape::logarithm)
                return std::nullopt;
            return member.fit.log_size(width);
        });
    const double finest = levels_[static_cast<std::size_t>(width)].back();
    const double open = std::exp(order.half_width() * std::abs(finest));
    size.low /= open;
    size.high *= open;
    return size;
}

std::vector<OrderInterval> estimate_orders(std::span<const ErrorRow> rows,
                                           const std::vector<double>& reference,
                                           const OrderTuning& tuning) {
    return OrderEnsemble(rows, reference, tuning).orders();
}

} // namespace tvbeam
