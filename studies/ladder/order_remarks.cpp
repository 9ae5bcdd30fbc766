#include "studies/ladder/order_remarks.hpp"

#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace tvbeam {

namespace {

std::string times_text(double value) {
    return significant(value, 2);
}

std::string order_text(double value) {
    constexpr double rounds_to_zero = 0.005; // and -0.00 is no order
    return fmt::format("{:.2f}", std::abs(value) < rounds_to_zero ? 0.0 : value);
}

double to_two_digits(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return unit * std::round(value / unit);
}

/// A rung by what is refined along the ladder; by both widths where another rung has its h.
std::string rung_name(std::span<const Refinement> ladder, const Refinement& rung) {
    std::string step = fmt::format("dt = {:.6g}", rung.dt);
    if (std::isnan(ladder.front().h) || ladder.front().h == ladder.back().h)
        return step;
    const bool is_only_one = std::ranges::none_of(ladder, [&](const Refinement& other) {
        return other.h == rung.h && !std::isnan(rung.dt) && other.dt != rung.dt;
    });
    return fmt::format("s = {:.0f}", 1.0 / rung.h) + (is_only_one ? "" : ", " + step);
}

/// That rung, and the finer ones: "s ≥ 40".
std::string from_rung_on(std::span<const Refinement> ladder, const Refinement& rung) {
    std::string name = rung_name(ladder, rung);
    return name.replace(name.find('='), 1, name.starts_with("dt") ? "≤" : "≥");
}

struct Observed {
    std::size_t rung;
    double order; ///< of the norm itself
};

std::string of_square(const Measure& norm, const std::string& order) {
    return norm.squared ? " (the square of order " + order + ")" : "";
}

std::string of_square(const Measure& norm, double order) {
    return of_square(norm, order_text(order));
}

/// Errors of the norm itself are compared, as the two-term model is one of it.
std::string as_large(const Measure& norm, double times) {
    return times_text(times) + " times as large" + (norm.squared ? " before squaring" : "");
}

/// Orders within this of each other are one.
constexpr double steady = 0.15;

/// The size of a term that is a smaller part of the other on every level comes from what models
/// leave of that: of 128 sentences of such 46 were untrue, and 0.2 was said of 0.026; of 42 of
/// larger ones none. A term whose size is not known at all is hidden where it is smaller; of a
/// larger one nothing is said: a thousandth of the other was called 41 times as large.
constexpr double small = 0.25;

std::string size_not_known(const Measure& norm, bool in_space) {
    return fmt::format("{}: how large the {} error is beside the {} error is not known.", norm.name,
                       in_space ? "space" : "time", in_space ? "time" : "space");
}

/// The orders of a ladder, and the first that leaves those before it.
struct Sequence {
    std::vector<Observed>::const_iterator first, leaves, end;
};

/// Orders along a ladder exist only where every step refines by the same ratio, in both widths.
bool refines_evenly(std::span<const Refinement> roots) {
    const auto evenly = [&](double Refinement::*width) {
        const double first = roots[0].*width / roots[1].*width;
        for (std::size_t i = 2; i < roots.size(); ++i)
            // What the records lack does not change.
            if (std::abs(roots[i - 1].*width / roots[i].*width / first - 1.0) > 0.01)
                return false;
        return true;
    };
    return refinement_ratio(roots[0], roots[1]) && evenly(&Refinement::h) &&
           evenly(&Refinement::dt);
}

/// Whether the order of dt in h, from level to level, is another: an order along such a ladder is
/// that of no refinement.
bool changes_proportions(std::span<const Refinement> all) {
    std::vector<Refinement> roots; // of those that have errors
    std::ranges::copy_if(all, std::back_inserter(roots),
                         [](const Refinement& root) { return std::isfinite(root.error); });
    std::optional<double> first;
    for (std::size_t i = 1; i < roots.size(); ++i) {
        const double in_h = std::log(roots[i - 1].h / roots[i].h);
        const double in_dt = std::log(roots[i - 1].dt / roots[i].dt);
        if (!std::isfinite(in_h) || !std::isfinite(in_dt))
            return false; // one width alone
        if (in_h == 0.0 && in_dt == 0.0)
            continue; // a level once more
        const double proportion = in_h == 0.0 ? 1e9 : in_dt / in_h;
        if (!first)
            first = proportion;
        else if (std::abs(proportion - *first) > 0.05 * (1.0 + std::abs(*first)))
            return true;
    }
    return false;
}

/// A dip of the error: its order is above a level into it, and below that out of it.
bool dips(const Sequence& orders, double level) {
    const auto into = std::find_if(orders.first, orders.end, [&](const Observed& seen) {
        return seen.order > level + steady;
    });
    return std::any_of(into, orders.end,
                       [&](const Observed& seen) { return seen.order < level - steady; });
}

/// Whether the orders are two in turn, one after the other, by which the error shrinks.
bool go_to_and_fro(const Sequence& orders) {
    constexpr std::ptrdiff_t fewest = 4; // fewer are a dip, or a hump
    if (orders.end - orders.first < fewest)
        return false;
    const std::array two{orders.first->order, (orders.first + 1)->order};
    const double alike = std::max(steady, 0.2 * std::abs(two[0] - two[1]));
    for (auto at = orders.first; at != orders.end; ++at)
        if (std::abs(at->order - two.at(static_cast<std::size_t>(at - orders.first) % 2)) > alike)
            return false;
    return std::abs(two[0] - two[1]) > steady && two[0] + two[1] > steady;
}

/// The orders from the first that leaves on, in words: up or down, and how they end. Why is said
/// only where the orders themselves show it; explained: a model says it already.
std::string departure(const Measure& norm, std::span<const Refinement> roots,
                      const Sequence& orders, bool explained) {
    const double power = norm.squared ? 2.0 : 1.0;
    const auto at = [&](const Observed& seen) {
        return order_text(power * seen.order) + " at " + rung_name(roots, roots[seen.rung]);
    };
    const auto [least, greatest] = std::minmax_element(
        orders.leaves, orders.end, [](const auto& a, const auto& b) { return a.order < b.order; });
    const double before = orders.first->order;
    const Observed& last = *(orders.end - 1);
    const bool rises = greatest->order > before + steady;
    const Observed& extreme = rises ? *greatest : *least;
    std::string text = (rises ? "; then it rises, to " : "; then it falls, to ") + at(extreme);
    if (rises && orders.leaves->order < before)
        text =
            "; then it falls, to " +
            at(*std::min_element(orders.leaves, greatest,
                                 [](const auto& a, const auto& b) { return a.order < b.order; })) +
            ", and rises, to " + at(extreme);
    const bool alternate = go_to_and_fro(orders);
    if (alternate)
        text = "; then it goes to and fro, between " +
               order_text(power * std::min(before, least->order)) + " and " +
               order_text(power * std::max(before, greatest->order));
    else if (last.rung != extreme.rung)
        text += "; " + at(last);
    if (!alternate && !rises && last.order <= 0.0)
        return text + ": the error no longer shrinks.";
    if (explained)
        return text + ".";
    if (changes_proportions(roots))
        return text + ", on a ladder that refines h and dt in proportions that change.";
    if (std::abs(last.order) < steady && std::abs((orders.end - 2)->order) < steady)
        return text + ": the error hardly shrinks any more.";
    const double last_step = std::abs(last.order - (orders.end - 2)->order);
    const bool settles = orders.end - orders.leaves >= 2 && last.order > 0.0 && last_step <= steady;
    if (!alternate && dips(orders, settles ? last.order : before))
        return text + ", as where two terms of the error cancel.";
    const double step_before = orders.end - orders.first < 3
                                   ? 0.0
                                   : std::abs((orders.end - 2)->order - (orders.end - 3)->order);
    const bool slows = last_step <= 0.02 || (last_step <= 0.06 && last_step <= 0.7 * step_before);
    if (settles && rises && slows && std::abs(last.order - extreme.order) <= steady)
        return text + ", where the last two orders agree, as where coarse levels do not show it.";
    if (settles && !rises && last.order <= extreme.order + 0.02)
        return text + ", as where a term of lower order takes over.";
    return text + (settles && slows
                       ? "; the last two orders agree, but why the others differ is not known."
                       : "; it has not settled, and why is not known.");
}

/// What the orders do. Why they do it is guessed where no model says it.
std::string from_pairs(const Measure& norm, std::span<const Refinement> roots,
                       const std::vector<Observed>& known, bool explained) {
    const double power = norm.squared ? 2.0 : 1.0;
    const auto less = [](const Observed& a, const Observed& b) { return a.order < b.order; };
    const double first = known.front().order;
    const auto leaves = std::find_if(known.begin(), known.end(), [&](const Observed& at) {
        return std::abs(at.order - first) > steady;
    });
    const auto [lowest, highest] = std::minmax_element(known.begin(), leaves, less);
    const auto range = [&, low = lowest->order, high = highest->order](double times) {
        return order_text(times * low) +
               (high - low >= 0.005 ? " to " + order_text(times * high) : "");
    };
    std::string text = norm.name + ": order " + range(power) + of_square(norm, range(1.0)) +
                       " up to " + rung_name(roots, roots[(leaves - 1)->rung]);
    if (leaves == known.end())
        return text + ".";
    return text + departure(norm, roots, {known.begin(), leaves, known.end()}, explained);
}

/// Whether a model has the errors of the ladder: one whose terms it does not know has others where
/// it takes the wrong one for the larger.
bool follows(const LadderForecast& view, std::span<const Refinement> roots) {
    constexpr double closely = 0.1;
    for (std::size_t i = 0; i < roots.size(); ++i)
        if (!(std::abs(view.rows[i].error - roots[i].error) <= closely * roots[i].error))
            return false;
    return true;
}

/// Of a ladder that refines one width alone: what the error of the other one, which stays, comes
/// to.
std::string from_what_stays(const Measure& norm, std::span<const Refinement> roots,
                            const TwoTermModel& model, const TermsKnown& known) {
    const auto same = [&](double Refinement::*width) {
        return std::ranges::all_of(
            roots, [&](const Refinement& root) { return root.*width == roots.front().*width; });
    };
    const bool in_time = same(&Refinement::dt);
    if (in_time == same(&Refinement::h))
        return {};
    const auto& last = roots.back();
    const double space = model.spatial(last.h);
    const double time = model.temporal(last.dt);
    constexpr double seen = 0.1; // of the other
    if (!((in_time ? time : space) > seen * (in_time ? space : time)))
        return {};
    const double times = in_time ? time / space : space / time;
    const bool knows_what_stays = in_time ? known.knows_time() : known.knows_space();
    const bool knows_other = in_time ? known.knows_space() : known.knows_time();
    if (!knows_what_stays || (!knows_other && times * small <= 1))
        return size_not_known(norm, in_time == knows_what_stays);
    if (times * small > 1 && !known.has_sizes())
        return fmt::format("{}: the {} error stays as it is along this ladder, as {} is the same; "
                           "it hides the {} error, whose size is not known.",
                           norm.name, in_time ? "time" : "space", in_time ? "dt" : "h",
                           in_time ? "space" : "time");
    return fmt::format("{}: the {} error stays as it is along this ladder, as {} is the same; at "
                       "{} it is {} as the {} error.",
                       norm.name, in_time ? "time" : "space", in_time ? "dt" : "h",
                       rung_name(roots, last), as_large(norm, times), in_time ? "space" : "time");
}

/// Why the orders are what they are: the faster term, of the higher order along the ladder, and the
/// slower one, which remains in the end.
std::string from_model(const Measure& norm, std::span<const Refinement> roots,
                       const TwoTermModel& model, const TermsKnown& known) {
    const LadderForecast view = forecast(model, roots);
    if (model.a == 0.0 || model.b == 0.0)
        return {};
    if (std::string stays = from_what_stays(norm, roots, model, known); !stays.empty())
        return stays;
    // A term that hardly shrinks was not seen by the fit, whatever it calls its order.
    if (view.asymptotic_order < 0.25 || !refines_evenly(roots))
        return {};
    const auto order = [&](double of_norm_itself) {
        return order_text((norm.squared ? 2.0 : 1.0) * of_norm_itself);
    };
    const bool space_is_faster = view.spatial_order > view.temporal_order;
    const std::string faster = space_is_faster ? "space" : "time";
    const std::string slower = space_is_faster ? "time" : "space";
    const double fast_order = std::max(view.spatial_order, view.temporal_order);
    const double slow_order = view.asymptotic_order;
    const auto share = [&](const ForecastRow& row) { // of the slower error, in the faster
        return space_is_faster ? row.temporal / row.spatial : row.spatial / row.temporal;
    };
    const double at_first = share(view.rows.front());
    const double at_last = share(view.rows.back());
    const std::string first = rung_name(roots, roots.front());
    const std::string last = rung_name(roots, roots.back());
    std::string text = norm.name + ": ";
    const bool is_hidden = at_last < 0.5;
    if (fast_order - slow_order < 0.1)
        return text + "space and time error fall alike along this ladder, with order" +
               (fast_order - slow_order < 0.03
                    ? " " + order(slow_order)
                    : "s " + order(view.spatial_order) + " and " + order(view.temporal_order)) +
               ".";
    const bool knows_faster = space_is_faster ? known.knows_space() : known.knows_time();
    const bool knows_slower = space_is_faster ? known.knows_time() : known.knows_space();
    const auto nearer_one = [](double share) { return std::min(share, 1 / share); };
    const bool has_size =
        std::max(nearer_one(at_first), nearer_one(at_last)) >= small || known.has_sizes();
    if (!(knows_faster && knows_slower) && !follows(view, roots) &&
        !(knows_faster && at_last <= small) && !(knows_slower && at_first * small >= 1))
        return size_not_known(norm, space_is_faster == !knows_faster);
    if (at_last < 1.0)
        text += fmt::format("the order {}{} is that of the {} error; the {} error, of order {} "
                            "along this ladder, is {} at {}{}",
                            order(fast_order), of_square(norm, fast_order), faster, slower,
                            order(slow_order), has_size ? as_large(norm, at_last) : "smaller", last,
                            !is_hidden ? "."
                            : has_size ? " and hidden."
                                       : " and hidden; its size is not known.");
    else if (at_first < 1.0)
        text +=
            fmt::format("the {} error, of order {}{}, dominates the coarse levels; at {} the {} "
                        "error, of order {}, is {}.",
                        faster, order(fast_order), of_square(norm, fast_order), last, slower,
                        order(slow_order), as_large(norm, at_last));
    else if (!has_size)
        text += fmt::format("the {} error, of order {}{}, dominates the whole ladder; the {} error "
                            "is hidden, and its size is not known.",
                            slower, order(slow_order), of_square(norm, slow_order), faster);
    else
        text += fmt::format("the {} error, of order {}{}, dominates the whole ladder: at {} it is "
                            "{} as the {} error, of order {}, and {} times at {}.",
                            slower, order(slow_order), of_square(norm, slow_order), first,
                            as_large(norm, at_first), faster, order(fast_order),
                            times_text(at_last), last);
    if (!has_size)
        return text;
    // What lies past the ladder hangs on which order is the lower one.
    const double open =
        view.spatial_order * known.half_p / model.p + view.temporal_order * known.half_q / model.q;
    const bool are_told_apart = fast_order - slow_order > open;
    if (view.cancellation && known.are_opposed(model.rho) &&
        (view.cancellation->row < roots.size() || are_told_apart))
        text += " The two have opposite signs and cancel in part about " +
                rung_name(roots, {.h = 1 / to_two_digits(1 / view.cancellation->h),
                                  .dt = to_two_digits(view.cancellation->dt)}) +
                ".";
    // Of orders that are nearly one nobody sees which it is.
    const bool are_apart = are_told_apart && fast_order - slow_order > 0.25;
    if (view.asymptotic_from && at_first < 1.0 && are_apart)
        text +=
            " The order that remains, " + order(slow_order) + ", appears " +
            (view.asymptotic_from->row < roots.size() ? "for " : "only for ") +
            from_rung_on(roots, {.h = view.asymptotic_from->h, .dt = view.asymptotic_from->dt}) +
            ".";
    return text;
}

/// A level without any error, between others: not of a solver that has come to the exact solution.
std::string lone_zero(const Measure& norm, std::span<const Refinement> roots) {
    const auto zero = std::ranges::find(roots, 0.0, &Refinement::error);
    const auto finer = std::find_if(zero, roots.end(),
                                    [](const Refinement& root) { return is_positive(root.error); });
    if (finer == roots.end())
        return {};
    return norm.name + ": the error is zero at " + rung_name(roots, *zero) + ", and not at " +
           rung_name(roots, *finer) +
           ", a finer level: no order goes through a zero, and it has no part in what is said of "
           "the others.";
}

} // namespace

std::vector<std::string> order_remarks(const Measure& norm, std::span<const Refinement> roots,
                                       const TwoTermModel* model, bool is_explained,
                                       const TermsKnown& terms) {
    const auto orders = observed_orders(roots);
    std::vector<Observed> known;
    for (std::size_t i = 0; i < orders.size(); ++i)
        if (orders[i])
            known.push_back({i, *orders[i]});
    const std::string zero = lone_zero(norm, roots);
    if (known.size() < 2)
        return zero.empty() ? std::vector<std::string>{} : std::vector{zero};
    const std::string why = model != nullptr ? from_model(norm, roots, *model, terms) : "";
    // Orders of steps that are uneven are as uneven, and no news beside a model.
    const bool explained =
        is_explained || !why.empty() || (model != nullptr && !refines_evenly(roots));
    std::vector<std::string> remarks{from_pairs(norm, roots, known, explained)};
    if (!why.empty())
        remarks.push_back(why);
    if (!zero.empty())
        remarks.push_back(zero);
    return remarks;
}

} // namespace tvbeam
