#include "studies/orders/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

/// An order below this is none: the error stands still.
constexpr double standstill = 0.05;
/// Past the window, an order below this part of the window's is taken for a floor's.
constexpr double floor_part = 0.5;
/// Rounding scatters about its floor by less than this factor; an error that grows by more
/// diverges.
constexpr double floor_scatter = 3.0;
/// A run of tiny orders after a longer run of much larger ones is a floor whose scatter looks
/// regular.
constexpr double much_larger = 4.0;
/// A row is described by the model where the two differ by less than this part of the error.
constexpr double model_tolerance = 0.2;

std::string text(const char* format, double first = 0, double second = 0) {
    char result[200];
    std::snprintf(result, sizeof result, format, first, second);
    return result;
}

bool agree(double left, double right, double tolerance) {
    return std::abs(left - right) <= tolerance * std::max(std::abs(left), std::abs(right));
}

/// The rows that have an error that is known, and the orders between them: a failed row in between
/// is passed over.
struct Usable {
    std::vector<std::size_t> rows;
    std::vector<Refinement> records;
    std::vector<std::optional<double>> orders;

    std::size_t size() const { return rows.size(); }
};

Usable usable_rows(std::span<const Refinement> ladder) {
    Usable usable;
    for (std::size_t i = 0; i < ladder.size(); ++i) {
        if (!std::isfinite(ladder[i].error) || ladder[i].error <= 0 || !ladder[i].is_resolved())
            continue;
        usable.rows.push_back(i);
        usable.records.push_back(ladder[i]);
    }
    usable.orders = observed_orders(usable.records);
    return usable;
}

/// Positions in Usable; the orders are those of first + 1 … last.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
    double order = 0;

    std::size_t orders() const { return last - first; }
};

double mean_order(const Usable& usable, std::size_t first, std::size_t last) {
    const auto ratio = refinement_ratio(usable.records[first], usable.records[last]);
    return ratio ? std::log(usable.records[first].error / usable.records[last].error) /
                       std::log(*ratio)
                 : 0.0;
}

/// The run that ends at `last` and grows towards coarser rows as long as they agree with it.
std::optional<Run> run_ending_at(const Usable& usable, std::size_t last,
                                 const VerdictOptions& options) {
    const auto sound = [&](std::size_t i) {
        return usable.orders[i] && *usable.orders[i] > standstill &&
               (!options.expected_order ||
                agree(*usable.orders[i], *options.expected_order, options.tolerance));
    };
    const std::size_t fewest = options.expected_order ? 1 : 2;
    if (!sound(last))
        return std::nullopt;
    std::size_t first = last - 1;
    while (first > 0 && sound(first) &&
           agree(*usable.orders[first], mean_order(usable, first, last), options.tolerance) &&
           agree(*usable.orders[first], *usable.orders[first + 1], options.tolerance))
        --first;
    if (last - first < fewest)
        return std::nullopt;
    return Run{first, last, mean_order(usable, first, last)};
}

/// A dip: steeper than the window's order into the row, flatter or back up out of it.
bool is_dip(const Usable& usable, std::size_t i, const Run& run, double tolerance) {
    return i + 1 < usable.size() && usable.orders[i] && usable.orders[i + 1] &&
           *usable.orders[i] > (1 + tolerance) * run.order &&
           *usable.orders[i + 1] < (1 - tolerance) * run.order;
}

double least_error(const Usable& usable, std::size_t last) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= last; ++i)
        least = std::min(least, usable.records[i].error);
    return least;
}

RowVerdict past_the_window(const Usable& usable, std::size_t i, const Run& run,
                           const VerdictOptions& options) {
    if (!usable.orders[i])
        return {Verdict::pre_asymptotic, "nothing is refined against the row before"};
    const double order = *usable.orders[i];
    if (order < 0 && usable.records[i].error > floor_scatter * least_error(usable, i))
        return {Verdict::diverging,
                text("the error grows again, order %.2f after %.2f", order, run.order)};
    if (order < floor_part * run.order)
        return {Verdict::floor, text("the error stands still near %.1e, order %.2f",
                                     usable.records[i].error, order)};
    if (agree(order, run.order, options.tolerance))
        return {Verdict::pre_asymptotic,
                text("order %.2f, but no longer with its neighbours", order)};
    return {Verdict::pre_asymptotic,
            text("order %.2f departs from the %.2f of the rows before", order, run.order)};
}

/// On its way into a floor the order falls through all values in between.
void lead_into_floor(const Usable& usable, const Run& run, const VerdictOptions& options,
                     std::vector<RowVerdict>& verdicts) {
    for (std::size_t i = usable.size() - 1; i-- > run.last + 1;)
        if (verdicts[i + 1].verdict == Verdict::floor &&
            verdicts[i].verdict == Verdict::pre_asymptotic && usable.orders[i] &&
            *usable.orders[i] < (1 - options.tolerance) * run.order)
            verdicts[i] = {Verdict::floor, text("a floor begins to show, order %.2f of %.2f",
                                                *usable.orders[i], run.order)};
}

std::vector<RowVerdict> with_window(const Usable& usable, const Run& run,
                                    const VerdictOptions& options) {
    std::vector<RowVerdict> verdicts(usable.size());
    for (std::size_t i = 0; i < usable.size(); ++i) {
        const bool inside = i >= run.first && i <= run.last;
        if (inside)
            verdicts[i] = {Verdict::asymptotic,
                           text("order %.2f over the rows that agree", run.order)};
        else if (is_dip(usable, i, run, options.tolerance))
            verdicts[i] = {Verdict::cancellation, text("the error dips, order %.2f and then %.2f",
                                                       *usable.orders[i], *usable.orders[i + 1])};
        else if (i > 0 && verdicts[i - 1].verdict == Verdict::cancellation)
            verdicts[i] = {Verdict::cancellation,
                           text("order %.2f out of the dip before", *usable.orders[i])};
        else if (i > run.last)
            verdicts[i] = past_the_window(usable, i, run, options);
        else if (usable.orders[i])
            verdicts[i] = {Verdict::pre_asymptotic,
                           text("order %.2f, finer rows show %.2f", *usable.orders[i], run.order)};
        else
            verdicts[i] = {Verdict::pre_asymptotic,
                           text("coarser than the rows that show order %.2f", run.order)};
    }
    lead_into_floor(usable, run, options, verdicts);
    return verdicts;
}

/// The orders of the window already run towards that of the finest row, by this part of the step
/// that is left: a drift, and no kink that one row shows.
constexpr double drift_part = 0.1;

/// Do finer rows contradict the window? A floor, a dip and a divergence past it are events of their
/// own; any other order is what the window's would have to be. The finest row alone is not
/// confirmed by another, so that its kink stands beside the window, unless the window drifts there.
bool is_refuted(const Usable& usable, const Run& run, const std::vector<RowVerdict>& verdicts) {
    for (std::size_t i = run.last + 1; i < usable.size(); ++i) {
        if (verdicts[i].verdict != Verdict::pre_asymptotic || !usable.orders[i])
            continue;
        if (i != run.last + 1 || i + 1 != usable.size())
            return true;
        const double step = *usable.orders[i] - *usable.orders[run.last];
        const double drift = *usable.orders[run.last] - *usable.orders[run.first + 1];
        if (drift * step > drift_part * step * step)
            return true;
    }
    return false;
}

/// The finest window that holds, and the verdicts it leads to.
struct Judged {
    Run run;
    std::vector<RowVerdict> verdicts;
};

std::optional<Judged> asymptotic_run(const Usable& usable, const VerdictOptions& options) {
    std::vector<Run> runs; // finest first
    for (std::size_t last = usable.size(); last-- > 1;)
        if (const auto run = run_ending_at(usable, last, options)) {
            runs.push_back(*run);
            last = run->first + 1;
        }
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const bool floor_in_disguise = std::any_of(
            runs.begin() + static_cast<std::ptrdiff_t>(k) + 1, runs.end(), [&](const Run& coarser) {
                return coarser.orders() >= runs[k].orders() &&
                       coarser.order > much_larger * runs[k].order;
            });
        if (floor_in_disguise)
            continue;
        auto verdicts = with_window(usable, runs[k], options);
        if (!is_refuted(usable, runs[k], verdicts))
            return Judged{runs[k], std::move(verdicts)};
    }
    return std::nullopt;
}

RowVerdict alone(double order, bool only_order, const VerdictOptions& options) {
    if (order < -standstill)
        return {Verdict::diverging, text("the error grows under refinement, order %.2f", order)};
    if (order <= standstill)
        return {Verdict::floor, text("the error does not change, order %.2f", order)};
    if (options.expected_order)
        return {Verdict::pre_asymptotic,
                text("order %.2f, expected is %.2f", order, *options.expected_order)};
    if (only_order)
        return {Verdict::pre_asymptotic, text("order %.2f, which no other row confirms", order)};
    return {Verdict::pre_asymptotic, text("order %.2f, the orders do not agree", order)};
}

std::vector<RowVerdict> without_window(const Usable& usable, const VerdictOptions& options) {
    std::vector<RowVerdict> verdicts(usable.size());
    const auto known = static_cast<std::size_t>(
        std::count_if(usable.orders.begin(), usable.orders.end(),
                      [](const auto& order) { return order.has_value(); }));
    for (std::size_t i = 0; i < usable.size(); ++i)
        verdicts[i] = usable.orders[i]
                          ? alone(*usable.orders[i], known == 1, options)
                          : RowVerdict{Verdict::pre_asymptotic, "one row alone shows no order"};
    // The first row is one end of the pair that is judged in the second.
    if (usable.size() > 1 && usable.orders[1])
        verdicts[0] = {verdicts[1].verdict, "first of a pair: " + verdicts[1].reason};
    return verdicts;
}

std::string ruled_by(const ForecastRow& row) {
    return row.ruling == Ruling::space ? "the h term rules" : "the dt term rules";
}

RowVerdict by_model(const LadderForecast& view, std::size_t i, std::size_t rows) {
    const auto& row = view.rows[i];
    if (row.ruling == Ruling::cancellation)
        return {Verdict::cancellation, text("the h term %.1e and the dt term %.1e cancel in part",
                                            row.spatial, row.temporal)};
    if (view.asymptotic_from && i >= view.asymptotic_from->row)
        return {Verdict::asymptotic,
                ruled_by(row) + text(", order %.2f to the end", view.asymptotic_order)};
    std::string reason =
        ruled_by(row) + text(" here; in the end the order is %.2f", view.asymptotic_order);
    if (view.asymptotic_from && view.asymptotic_from->row >= rows)
        reason += text(", from h = %.1e, dt = %.1e on", view.asymptotic_from->h,
                       view.asymptotic_from->dt);
    return {Verdict::pre_asymptotic, reason};
}

/// Rows of which the model speaks true take its verdict.
void prefer_model(const Usable& usable, const VerdictOptions& options,
                  std::vector<RowVerdict>& verdicts) {
    for (const auto& record : usable.records)
        if (!(record.h > 0 && record.dt > 0 && std::isfinite(record.h * record.dt)))
            return;
    const auto view = forecast(*options.model, usable.records, options.tolerance);
    for (std::size_t i = 0; i < usable.size(); ++i)
        if (std::abs(usable.records[i].error - view.rows[i].error) <=
            model_tolerance * usable.records[i].error)
            verdicts[i] = by_model(view, i, usable.size());
}

RowVerdict unusable(const Refinement& record) {
    const double error = record.error;
    if (!std::isnan(error) && !record.is_resolved())
        return {Verdict::unresolved, text("uncertain by %.1e of itself", record.uncertainty)};
    if (error == 0)
        return {Verdict::exact, "the error is zero"};
    if (std::isnan(error))
        return {Verdict::failed, "the error is not a number"};
    return {Verdict::failed, error < 0 ? "the error is negative" : "the error is infinite"};
}

} // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::asymptotic:
        return "asymptotic";
    case Verdict::pre_asymptotic:
        return "pre-asymptotic";
    case Verdict::cancellation:
        return "cancellation";
    case Verdict::floor:
        return "floor";
    case Verdict::diverging:
        return "diverging";
    case Verdict::unresolved:
        return "unresolved";
    case Verdict::exact:
        return "exact";
    case Verdict::failed:
        break;
    }
    return "failed";
}

LadderVerdict judge(std::span<const Refinement> ladder, const VerdictOptions& options) {
    LadderVerdict result;
    for (const auto& record : ladder)
        result.rows.push_back(unusable(record));
    const auto usable = usable_rows(ladder);
    if (usable.size() == 0)
        return result;
    auto judged = asymptotic_run(usable, options);
    auto verdicts = judged ? std::move(judged->verdicts) : without_window(usable, options);
    if (judged)
        result.window = {usable.rows[judged->run.first], usable.rows[judged->run.last],
                         judged->run.order};
    if (options.model != nullptr)
        prefer_model(usable, options, verdicts);
    for (std::size_t i = 0; i < usable.size(); ++i)
        result.rows[usable.rows[i]] = std::move(verdicts[i]);
    return result;
}

} // namespace tvbeam
