#include "studies/orders/order_engine.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace tvbeam {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double normal_quantile = 1.959963984540054; // of 97.5 %
constexpr std::size_t fewest_levels = 3;
/// Rows where the others are finest: all, and those of this many finest levels.
constexpr int finest_levels[] = {3, 2, 1};

using Index = Eigen::Index;

std::string with_number(const char* format, double number) {
    char text[160];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

bool is_positive(double value) {
    return std::isfinite(value) && value > 0;
}

/// Rows with a logarithm; those of equal widths are one row of their mean, and of their number's
/// weight.
TermRows usable_rows(std::span<const ErrorRow> given) {
    std::map<std::vector<double>, std::vector<double>> logs;
    for (const auto& row : given)
        if (is_positive(row.error) &&
            std::all_of(row.widths.begin(), row.widths.end(), is_positive))
            logs[row.widths].push_back(std::log(row.error));
    const auto n = static_cast<Index>(logs.size());
    const auto d = given.empty() ? Index{0} : static_cast<Index>(given.front().widths.size());
    TermRows rows{Eigen::MatrixXd(n, d), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    Index r = 0;
    for (const auto& [widths, errors] : logs) {
        for (Index i = 0; i < d; ++i)
            rows.log_widths(r, i) = std::log(widths[static_cast<std::size_t>(i)]);
        const Eigen::Map<const Eigen::VectorXd> all(errors.data(),
                                                    static_cast<Index>(errors.size()));
        rows.log_errors[r] = all.mean();
        rows.weights[r++] = static_cast<double>(errors.size());
    }
    if (n > 0)
        rows.weights /= rows.weights.mean();
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

int level_of(const std::vector<double>& levels, double log_width) {
    const auto finer = std::upper_bound(levels.begin(), levels.end(), log_width, std::greater<>());
    // The last level that is not finer than the width.
    const auto exact = std::find(levels.begin(), levels.end(), log_width);
    return static_cast<int>((exact != levels.end() ? exact : finer - 1) - levels.begin());
}

/// How many of the coarsest levels a window may leave out: the rest is at least three, and half.
int most_dropped(std::size_t levels) {
    const auto spare = static_cast<int>(levels) - static_cast<int>(fewest_levels);
    return std::max(0, std::min(spare, static_cast<int>(levels) / 2));
}

/// The leading terms; next terms in one width; next terms in all.
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
    return shapes;
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

double student_over_normal(int dof) {
    return dof < 1 ? infinity : gsl_cdf_tdist_Pinv(0.975, dof) / normal_quantile;
}

} // namespace

OrderEnsemble::OrderEnsemble(std::span<const ErrorRow> rows, std::vector<double> reference,
                             const OrderTuning& tuning)
    : tuning_(tuning), rows_(usable_rows(rows)) {
    if (!reference.empty())
        rows_.log_reference =
            Eigen::Map<const Eigen::ArrayXd>(reference.data(), static_cast<Index>(reference.size()))
                .log();
    for (Index i = 0; i < rows_.widths(); ++i) {
        levels_.push_back(levels_of(rows_.log_widths.col(i), tuning_.one_level));
        if (levels_.back().size() < fewest_levels)
            failure_ = "an order needs errors at three widths that differ by an eighth or more";
    }
    if (rows_.size() == 0)
        failure_ = "no row has a positive error";
    if (!failure_.empty())
        return;
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
        {{TermShape::none}}, {{1.0}}, {{2.0}}, {{TermShape::logarithm}}, {{TermShape::none}, true}};
    const auto& levels = levels_.front();
    for (int dropped = 0; dropped + 2 <= static_cast<int>(levels.size()); ++dropped) {
        std::vector<Index> chosen;
        for (Index r = 0; r < rows.size(); ++r)
            if (level_of(levels, rows.log_widths(r, 0)) >= dropped)
                chosen.push_back(r);
        const auto window = rows.subset(chosen);
        for (std::size_t k = 0; k < shapes.size(); ++k)
            if (static_cast<int>(levels.size()) - dropped >= shapes[k].parameters())
                if (auto fit = fit_terms(window, shapes[k]))
                    members_.push_back({std::move(*fit), static_cast<int>(k), {dropped}});
    }
}

void OrderEnsemble::fit_all_widths(const TermRows& rows) {
    std::vector<int> most;
    for (const auto& levels : levels_)
        most.push_back(most_dropped(levels.size()));
    const auto shapes = shapes_of(levels_.size());
    for (const auto& place : places_within(most)) {
        std::vector<Index> chosen;
        for (Index r = 0; r < rows.size(); ++r) {
            bool inside = true;
            for (std::size_t i = 0; i < place.size(); ++i)
                inside = inside && level_of(levels_[i],
                                            rows.log_widths(r, static_cast<Index>(i))) >= place[i];
            if (inside)
                chosen.push_back(r);
        }
        const auto window = rows.subset(chosen);
        std::optional<TermFit> plain;
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            if (window.size() <= shapes[k].parameters())
                continue;
            auto fit = fit_terms(window, shapes[k], plain ? &*plain : nullptr);
            if (!fit)
                continue;
            if (k == 0)
                plain = fit;
            members_.push_back({std::move(*fit), static_cast<int>(k), place});
        }
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

namespace {

using Numbers = std::map<std::pair<int, std::vector<int>>, FittedNumber>;

/// The greatest change of a number when its window changes by one level, on any axis. Where an axis
/// has no other window another model of the same window stands in, with the change of its own. None
/// where there is nothing to compare with.
std::optional<double> change_of(const Numbers& numbers, int family, const std::vector<int>& place) {
    const double value = numbers.at({family, place}).value;
    double change = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        bool compared = false;
        for (const int step : {-1, 1}) {
            auto beside = place;
            beside[i] += step;
            if (const auto found = numbers.find({family, beside}); found != numbers.end()) {
                change = std::max(change, std::abs(found->second.value - value));
                compared = true;
            }
        }
        if (compared)
            continue;
        const int leading = family - family % 100;
        const int stand_in = family == leading ? leading + 1 : leading;
        const auto found = numbers.find({stand_in, place});
        if (found == numbers.end())
            return std::nullopt;
        change = std::max(change, std::abs(found->second.value - value));
        if (family != leading) {
            const auto further = change_of(numbers, leading, place);
            if (!further)
                return std::nullopt;
            change = std::max(change, *further);
        }
    }
    return change;
}

} // namespace

std::optional<OrderEnsemble::Mixture> OrderEnsemble::mix(const Functional& number) const {
    Numbers numbers;
    for (const auto& member : members_)
        if (const auto one = number(member); one && std::isfinite(one->value))
            numbers[{member.family, member.place}] = {
                one->value,
                // A sequence's shortest windows are exact: all that is known of them is their
                // drift.
                member.fit.dof == 0 && levels_.size() == 1
                    ? 0.0
                    : one->error * student_over_normal(member.fit.dof)};
    double weights = 0;
    double mean = 0;
    double square = 0;
    for (const auto& [where, one] : numbers) {
        auto change = change_of(numbers, where.first, where.second);
        if (!change)
            continue;
        const double unit = std::hypot(one.error, *change);
        if (!std::isfinite(unit))
            continue;
        const double weight = 1 / ((unit + tuning_.agreement) * (unit + tuning_.agreement));
        weights += weight;
        mean += weight * one.value;
        square += weight * (one.value * one.value + unit * unit);
    }
    if (!(weights > 0))
        return std::nullopt;
    mean /= weights;
    const double spread = std::sqrt(std::max(0.0, square / weights - mean * mean));
    const double factor = levels_.size() == 1 ? sequence_factor() : tuning_.grid;
    return Mixture{mean, factor * spread + tuning_.narrowest};
}

double OrderEnsemble::sequence_factor() const {
    const auto spare = static_cast<double>(levels_.front().size()) - 2;
    return tuning_.sequence * (1 + tuning_.few_levels / (spare * spare));
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

/// The order in windows that leave out ever more of the coarse levels, over all members without
/// next terms.
std::string OrderEnsemble::motion(Index width) const {
    std::map<int, std::pair<double, int>> sums;
    for (const auto& member : members_)
        if (member.family == 0) {
            auto& [sum, count] = sums[member.place[static_cast<std::size_t>(width)]];
            sum += member.fit.order(width).value;
            ++count;
        }
    std::vector<double> means;
    means.reserve(sums.size());
    for (const auto& [place, sum] : sums)
        means.push_back(sum.first / sum.second);
    if (means.size() < 2)
        return {};
    const double last = means.back();
    const double step = last - means[means.size() - 2];
    if (std::abs(step) < tuning_.standstill || std::abs(last) > 20)
        return {};
    for (std::size_t i = 1; i < means.size(); ++i)
        if ((means[i] - means[i - 1]) * step <= 0)
            return {};
    return step > 0 ? with_number("rising past %.2f", last)
                    : with_number("falling below %.2f", last);
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
        order.determined = mixture && order.share >= tuning_.least_share && order.low > 0 &&
                           mixture->half <= tuning_.widest;
        if (order.determined)
            continue;
        order.status = order.share < tuning_.least_share
                           ? "hidden: its term is less than 15 % of every error"
                           : motion(width);
        if (order.status.empty())
            order.status = "models and windows do not agree";
    }
    return result;
}

OrderInterval OrderEnsemble::forecast(const std::vector<double>& widths) const {
    const Eigen::VectorXd log_widths =
        Eigen::Map<const Eigen::ArrayXd>(widths.data(), static_cast<Index>(widths.size())).log();
    OrderInterval result{.status = failure_};
    const auto mixture = mix([&](const EnsembleMember& member) -> std::optional<FittedNumber> {
        if (member.along >= 0)
            return std::nullopt;
        return member.fit.log_error(log_widths);
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
