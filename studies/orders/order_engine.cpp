#include "studies/orders/order_engine.hpp"

#include "studies/orders/left_open.hpp"

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

} // namespace

OrderEnsemble::OrderEnsemble(std::span<const ErrorRow> rows, const std::vector<double>& reference,
                             const OrderTuning& tuning)
    : OrderEnsemble(rows_of(rows, reference, tuning.most_rows), tuning) {}

OrderEnsemble::OrderEnsemble(TermRows rows, const OrderTuning& tuning, bool may_scatter)
    : tuning_(tuning), rows_(std::move(rows)) {
    for (Index i = 0; i < rows_.widths(); ++i) {
        levels_.push_back(levels_of(rows_.log_widths.col(i), tuning_.one_level));
        if (levels_.back().size() < fewest_levels)
            failure_ = tuning_.of_steps
                           ? "an order of values needs steps from one to the next at three widths "
                             "that differ by an eighth or more"
                       : levels_.back().size() == 1
                           ? "all rows have the same width, or nearly"
                           : "an order needs errors at three widths that differ by an eighth or "
                             "more";
    }
    if (rows_.size() < 2)
        failure_ = rows_.size() == 0 ? "no row has a positive error"
                                     : "one width alone has a positive error";
    // Of 75 orders of three widths, each refined from the finest row alone, 24 of 54 were wrong.
    for (Index i = 0; rows_.widths() > 2 && i < rows_.widths() && failure_.empty(); ++i)
        for (Index j = 0; j < i && failure_.empty(); ++j)
            if (!are_refined_apart(rows_, levels_, i, j))
                failure_ = "orders of three widths need rows that refine each two of them apart, "
                           "as in all pairs of two and two";
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
        if (member.is_of_all_rows())
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
        const bool is_of_all = member.is_of_all_rows();
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
            if ((member.along >= 0 && member.along != width) ||
                leans_on_a_constant(member, width) || is_of_the_others(member))
                return std::nullopt;
            return member.fit.order(member.along < 0 ? width : 0);
        });
        if (mixture) {
            const double half =
                std::max({mixture->half, distance_to_slow_terms(width, mixture->value),
                          distance_to_close_terms(width, mixture->value),
                          distance_left_open(rows_, tuning_.log_finest, mixture->value)});
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
            order.levels_off = rows_.widths() == 1 && is_near_zero(order);
            order.status = status_of(width, order);
            order.falls = motion_of(width).falls();
        }
    }
    if (const std::string status = steps_contradict(result); !status.empty())
        for (auto& order : result)
            if (order.determined) {
                order.determined = false;
                order.status = status;
            }
    return result;
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
