// What members say of a number, put together: a value and its half-width (order_engine.hpp).
#include "studies/orders/order_engine.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tvbeam {

using Index = Eigen::Index;

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

} // namespace tvbeam
