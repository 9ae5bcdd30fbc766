#include "studies/orders/order_members.hpp"

#include "studies/orders/term_search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// Rows where the others are finest: all, and those of this many finest levels.
constexpr int finest_levels[] = {3, 2, 1};

using Index = Eigen::Index;
using AllLevels = std::vector<std::vector<double>>;

/// How many of the coarsest levels a window may leave out: the rest is at least three, and half.
int most_dropped(std::size_t levels) {
    constexpr int most = 6; // more windows cost time alone
    const auto spare = static_cast<int>(levels) - static_cast<int>(fewest_levels);
    return std::max(0, std::min({spare, static_cast<int>(levels) / 2, most}));
}

/// The leading terms; next terms in one width; next terms in all; next terms half an order on,
/// logarithms and constants, in one width, the others without or with next terms; all of them
/// saturated.
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
    shapes.push_back({.next = plain, .saturates = true});
    return shapes;
}

/// Or terms that saturate: a shape that counts where none of the others is as close.
bool has_next_terms_of_two_kinds(const TermShape& shape) {
    if (shape.saturates)
        return true;
    std::vector<double> kinds = shape.next;
    std::erase(kinds, TermShape::none);
    return std::ranges::adjacent_find(kinds, std::ranges::not_equal_to()) != kinds.end();
}

/// Whether the largest term is far larger than the error in every row: the error is then a
/// difference of two, whose orders are close to each other, or to zero, and stand for a curve that
/// no power has. Of a term that a reference has as well, what is left of it counts.
bool is_a_difference(const TermFit& fit, const TermRows& rows) {
    constexpr double far_larger = 10;
    for (Index r = 0; r < rows.size(); ++r) {
        double largest = 0;
        for (Index i = 0; i < rows.widths(); ++i)
            largest = std::max(largest, fit.measured_term(i, rows.log_widths(r, i)));
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
            std::abs(fit.next(static_cast<Index>(i)).value) < least)
            return true;
    return false;
}

/// At how many values of a width its term is a part of an error that is seen.
std::size_t levels_with(const TermFit& fit, Index width, const TermRows& rows) {
    constexpr double seen = 0.01;
    std::set<double> levels;
    for (Index r = 0; r < rows.size(); ++r)
        if (const double log_width = rows.log_widths(r, width);
            fit.measured_term(width, log_width) >= seen * std::exp(rows.log_errors[r]))
            levels.insert(log_width);
    return levels.size();
}

/// Whether a term that a reference has as well goes on to no order at all, b (x^q − x_ref^q) with
/// q → 0 and b → ∞, or to ever greater ones that a level or two alone show: what the search ends at
/// then hangs on the last bit of the errors.
bool has_no_end(const TermFit& fit, const TermRows& rows) {
    constexpr double least = 0.02;
    constexpr double great = 10;
    for (Index i = 0; i < rows.log_reference.size(); ++i)
        if (const double order = fit.order(i).value;
            !std::isnan(rows.log_reference[i]) &&
            (!(std::abs(order) >= least && order >= -great) ||
             (order > great && levels_with(fit, i, rows) < fewest_levels)))
            return true;
    return false;
}

bool is_believable(const TermFit& fit, const TermRows& rows) {
    return !is_a_difference(fit, rows) && !has_lost_its_logarithm(fit);
}

/// Where the leading terms alone have no end the rest is of use, but nothing is known of them.
void forget_errors(TermFit& fit) {
    fit.covariance.diagonal().setConstant(infinity);
    fit.root.resize(0, 0);
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

/// One width: windows down to the two finest levels, for models that have no more parameters than
/// the window has levels.
void fit_sequence(const TermRows& rows, const std::vector<double>& levels,
                  std::vector<EnsembleMember>& members) {
    const std::vector<TermShape> shapes{
        {{TermShape::none}},       {{1.0}}, {{2.0}}, {{TermShape::logarithm}},
        {{TermShape::none}, true}, {{0.5}}};
    constexpr std::size_t most_windows = 24;
    const auto step = static_cast<int>(1 + levels.size() / most_windows);
    // Of three levels two logarithms, of either sign, have the order and its change: that which
    // more levels show is the one.
    std::vector<std::optional<TermFit>> wider(shapes.size());
    for (int place = 0; place * step + 2 <= static_cast<int>(levels.size()); ++place) {
        const int dropped = place * step;
        std::vector<Index> chosen;
        for (Index r = 0; r < rows.size(); ++r)
            if (level_of(levels, rows.log_widths(r, 0)) >= dropped)
                chosen.push_back(r);
        TermSearch search(rows.subset(chosen));
        for (std::size_t k = 0; k < shapes.size(); ++k)
            if (static_cast<int>(levels.size()) - dropped >= shapes[k].parameters())
                if (auto fit = search.fit(shapes[k], nullptr, wider[k] ? &*wider[k] : nullptr)) {
                    wider[k] = fit;
                    members.push_back({std::move(*fit), static_cast<int>(k), {place}});
                }
    }
}

/// The rows that are in a window of all widths.
TermRows rows_from(const TermRows& rows, const AllLevels& levels, const std::vector<int>& place) {
    std::vector<Index> chosen;
    for (Index r = 0; r < rows.size(); ++r) {
        bool inside = true;
        for (std::size_t i = 0; i < place.size(); ++i)
            inside = inside &&
                     level_of(levels[i], rows.log_widths(r, static_cast<Index>(i))) >= place[i];
        if (inside)
            chosen.push_back(r);
    }
    return rows.subset(chosen);
}

void fit_all_widths(const TermRows& rows, const AllLevels& levels,
                    std::vector<EnsembleMember>& members) {
    std::vector<int> most;
    for (const auto& own : levels)
        most.push_back(most_dropped(own.size()));
    const auto shapes = shapes_of(levels.size());
    // Where the search from nothing ends in a false valley, that from another window's fit does
    // not.
    constexpr int fewest_spare = 2; // rows: seven parameters follow any nine
    std::vector<std::optional<TermFit>> closest(
        shapes.size()); // of the widest window, if it can be
    for (const auto& place : places_within(most)) {
        const auto window = rows_from(rows, levels, place);
        if (window.size() == 0)
            continue; // of a grid without its finest corner
        TermSearch search(window);
        std::optional<TermFit> plain;
        double least_scale = infinity; // of those with next terms of one kind
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const bool of_two_kinds = has_next_terms_of_two_kinds(shapes[k]);
            if (window.size() <= shapes[k].parameters() + (of_two_kinds ? fewest_spare : 0))
                continue;
            if (shapes[k].saturates && rows.log_reference.size() > 0)
                continue; // what a reference takes off a sum is not that of the sum
            auto fit = search.fit(shapes[k], plain ? &*plain : nullptr,
                                  closest[k] ? &*closest[k] : nullptr);
            if (!fit || !is_believable(*fit, window))
                continue;
            if (has_no_end(*fit, window)) {
                if (k > 0)
                    continue;
                forget_errors(*fit);
            }
            if (k == 0)
                plain = fit;
            if (!of_two_kinds)
                least_scale = std::min(least_scale, fit->scale);
            else if (fit->scale > std::max(least_scale, scale_of_rounding))
                continue; // what fits no better with more parameters follows scatter
            if (!closest[k] || is_far_worse(*closest[k], *fit))
                closest[k] = fit;
            members.push_back({std::move(*fit), static_cast<int>(k), place});
        }
    }
    for (auto& member : members) {
        const auto& best = *closest[static_cast<std::size_t>(member.family)];
        if (!is_far_worse(member.fit, best))
            continue;
        const auto window = rows_from(rows, levels, member.place);
        auto fit = TermSearch(window).fit(best.shape, &member.fit, &best);
        if (fit && fit->scale < member.fit.scale && is_believable(*fit, window) &&
            !has_no_end(*fit, window))
            member.fit = std::move(*fit);
    }
}

void fit_each_alone(const TermRows& rows, const AllLevels& levels,
                    std::vector<EnsembleMember>& members) {
    const auto shapes = shapes_of(1);
    for (Index i = 0; i < rows.widths(); ++i) {
        const auto& own = levels[static_cast<std::size_t>(i)];
        for (const auto& place : places_within({most_dropped(own.size()), 3})) {
            std::vector<Index> chosen;
            for (Index r = 0; r < rows.size(); ++r) {
                bool inside = level_of(own, rows.log_widths(r, i)) >= place[0];
                for (Index j = 0; j < rows.widths(); ++j) {
                    const auto& other = levels[static_cast<std::size_t>(j)];
                    if (j != i && place[1] > 0)
                        inside = inside &&
                                 level_of(other, rows.log_widths(r, j)) >=
                                     static_cast<int>(other.size()) - finest_levels[place[1] - 1];
                }
                if (inside)
                    chosen.push_back(r);
            }
            if (chosen.empty())
                continue; // of a grid without its finest corner
            TermSearch search(rows.subset(chosen).along(i));
            for (std::size_t k = 0; k < shapes.size(); ++k)
                if (std::ssize(chosen) > shapes[k].parameters())
                    if (auto fit = search.fit(shapes[k]))
                        members.push_back(
                            {std::move(*fit),
                             families_of_a_width * static_cast<int>(i + 1) + static_cast<int>(k),
                             place, i});
        }
    }
}

/// The part of each error that the term of one width is.
Eigen::ArrayXd shares_of_errors(const TermFit& fit, Index width, const TermRows& rows) {
    Eigen::ArrayXd shares(rows.size());
    for (Index r = 0; r < rows.size(); ++r)
        shares[r] =
            fit.measured_term(width, rows.log_widths(r, width)) / std::exp(rows.log_errors[r]);
    return shares;
}

} // namespace

bool is_far_worse(const TermFit& fit, const TermFit& other) {
    constexpr double far = 10;
    return fit.scale > far * std::max(other.scale, scale_of_rounding);
}

double share_of_errors(const TermFit& fit, Index width, const TermRows& rows) {
    double greatest = 0;
    for (const double share : shares_of_errors(fit, width, rows))
        greatest = std::max(greatest, share);
    return greatest;
}

double mean_share_of_errors(const TermFit& fit, Index width, const TermRows& rows) {
    return std::sqrt(shares_of_errors(fit, width, rows).square().mean());
}

std::vector<EnsembleMember> fit_members(const TermRows& rows, const AllLevels& levels) {
    std::vector<EnsembleMember> members;
    if (rows.widths() == 1) {
        fit_sequence(rows, levels.front(), members);
        return members;
    }
    fit_all_widths(rows, levels, members);
    fit_each_alone(rows, levels, members);
    return members;
}

} // namespace tvbeam
