#include "studies/orders/verdict.hpp"

#include "studies/orders/ladder_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

namespace {

constexpr VerdictTuning tuning;

/// Levels first … last whose orders, those of first + 1 … last, agree.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
    double order = 0;

    std::size_t orders() const { return last - first; }
};

/// The orders between levels, judged without a model.
class Pairwise {
public:
    Pairwise(std::vector<Level> levels, const VerdictOptions& options)
        : levels_(std::move(levels)), options_(options) {
        auto [values, slack] = orders_of(levels_);
        orders_ = std::move(values);
        slack_ = std::move(slack);
        const auto agreeing = all_runs(false);
        const bool shows_last = knows_last() && find_window(all_runs(true), agreeing);
        if (!shows_last && !find_window(agreeing, agreeing))
            judge_without_window();
        if (options_.order != nullptr && !options_.expected_order && size() > 1 &&
            (run_ || options_.order->determined))
            tell_from_last(shows_last);
    }
    const std::vector<RowVerdict>& verdicts() const { return verdicts_; }
    const std::optional<Run>& run() const { return run_; }

private:
    std::size_t size() const { return levels_.size(); }

    bool agree(double left, double right, double slack) const {
        return std::abs(left - right) <=
               options_.tolerance * std::max(std::abs(left), std::abs(right)) + slack;
    }

    /// Whether the order into a level agrees with another, which may itself be another.
    bool agrees(std::size_t i, double order, double slack = 0.0) const {
        return agree(*orders_[i], order, slack_[i] + slack);
    }

    /// Whether the order into a level agrees with that of the finer ones to `last` and of the next.
    bool joins(std::size_t i, std::size_t last) const {
        return agrees(i, mean_order(i, last), slack_between(levels_[i], levels_[last])) &&
               agrees(i, *orders_[i + 1], slack_[i + 1]);
    }

    /// Whether an order stands that all levels determine.
    bool knows_last() const {
        return options_.order != nullptr && options_.order->determined && !options_.expected_order;
    }

    bool is_sound(std::size_t i) const {
        return orders_[i] && *orders_[i] > tuning.standstill &&
               (!options_.expected_order || agrees(i, *options_.expected_order));
    }

    /// Whether the order into a level may be that which all levels determine.
    bool may_be_last(std::size_t i) const {
        const auto& last = *options_.order;
        return orders_[i] &&
               std::abs(*orders_[i] - last.value) <=
                   std::max(options_.tolerance * last.value, last.half_width() / 2) + slack_[i];
    }

    double mean_order(std::size_t first, std::size_t last) const {
        const Refinement ends[] = {levels_[first].mean, levels_[last].mean};
        return observed_orders(ends)[1].value_or(0.0);
    }

    /// The run that ends at `last` and grows towards coarser levels as long as they agree with it;
    /// of_last, as long as they show the order that all levels determine: where that is known to
    /// the tolerance it need not be seen from one row to the next.
    std::optional<Run> run_ending_at(std::size_t last, bool of_last) const {
        const auto may_stand = [&](std::size_t i) {
            return is_sound(i) && (!of_last || may_be_last(i));
        };
        if (!may_stand(last))
            return std::nullopt;
        const bool is_known =
            of_last && options_.order->half_width() <= options_.tolerance * options_.order->value;
        std::size_t first = last - 1;
        while (first > 0 && may_stand(first) && (is_known || joins(first, last)))
            --first;
        const std::size_t fewest = options_.expected_order ? 1 : 2;
        if (last - first < fewest)
            return std::nullopt;
        return Run{first, last, mean_order(first, last)};
    }

    /// All of them, finest first.
    std::vector<Run> all_runs(bool of_last) const {
        std::vector<Run> runs;
        for (std::size_t last = size(); last-- > 1;)
            if (const auto run = run_ending_at(last, of_last)) {
                runs.push_back(*run);
                last = run->first + 1;
            }
        return runs;
    }

    /// The finest of some runs that finer levels do not refute, and verdicts with it. A run after
    /// one as long that agrees on a much larger order is a floor whose scatter looks regular.
    bool find_window(const std::vector<Run>& runs, const std::vector<Run>& agreeing) {
        for (const Run& run : runs) {
            const bool floor_in_disguise = std::ranges::any_of(agreeing, [&](const Run& coarser) {
                return coarser.last <= run.first && coarser.orders() >= run.orders() &&
                       coarser.order > tuning.much_larger * run.order;
            });
            if (floor_in_disguise)
                continue;
            judge_with(run);
            if (!is_refuted(run)) {
                run_ = run;
                return true;
            }
            verdicts_.clear();
        }
        return false;
    }

    /// A dip: steeper than the window's order into the level, flatter or back up out of it.
    bool is_dip(std::size_t i, const Run& run) const {
        return i + 1 < size() && orders_[i] && orders_[i + 1] &&
               *orders_[i] - slack_[i] > (1 + options_.tolerance) * run.order &&
               *orders_[i + 1] + slack_[i + 1] < (1 - options_.tolerance) * run.order;
    }

    void judge_with(const Run& run) {
        verdicts_.assign(size(), {});
        double least = levels_.empty() ? 0.0 : levels_.front().mean.error;
        for (std::size_t i = 0; i < size(); ++i) {
            least = std::min(least, levels_[i].mean.error);
            if (i >= run.first && i <= run.last)
                verdicts_[i] = {Verdict::asymptotic, reason_within(run)};
            else if (is_dip(i, run))
                verdicts_[i] = {Verdict::cancellation,
                                fmt::format("the error dips, order {:.2f} and then {:.2f}",
                                            *orders_[i], *orders_[i + 1])};
            else if (i > 0 && verdicts_[i - 1].verdict == Verdict::cancellation)
                verdicts_[i] = {Verdict::cancellation,
                                fmt::format("order {:.2f} out of the dip before", *orders_[i])};
            else if (i > run.last)
                verdicts_[i] = past_the_window(i, run, least);
            else
                verdicts_[i] = {
                    Verdict::pre_asymptotic,
                    fmt::format("coarser than the rows that show order {:.2f}", run.order)};
        }
        // On its way into a floor the order falls through all values in between.
        for (std::size_t i = size() - 1; i-- > run.last + 1;)
            if (verdicts_[i + 1].verdict == Verdict::floor &&
                verdicts_[i].verdict == Verdict::pre_asymptotic && orders_[i] &&
                *orders_[i] < (1 - options_.tolerance) * run.order)
                verdicts_[i] = {Verdict::floor,
                                fmt::format("a floor begins to show, order {:.2f} of {:.2f}",
                                            *orders_[i], run.order)};
    }

    RowVerdict past_the_window(std::size_t i, const Run& run, double least) const {
        if (!orders_[i])
            return {Verdict::pre_asymptotic, "not finer than the row before in all that changes"};
        const double order = *orders_[i];
        if (order < 0 && levels_[i].mean.error > tuning.floor_scatter * least)
            return {
                Verdict::diverging,
                fmt::format("the error grows again, order {:.2f} after {:.2f}", order, run.order)};
        if (order < tuning.floor_part * run.order)
            return {Verdict::floor, fmt::format("the error no longer falls as before, near {:.1e}",
                                                levels_[i].mean.error)};
        if (agrees(i, run.order))
            return {Verdict::pre_asymptotic,
                    fmt::format("order {:.2f}, but no longer with its neighbours", order)};
        return {Verdict::pre_asymptotic,
                fmt::format("order {:.2f} departs from the {:.2f} of the rows before", order,
                            run.order)};
    }

    /// Do finer levels contradict the window? A floor, a dip and a divergence past it are events of
    /// their own; any other order is what the window's would have to be. The finest level alone is
    /// not confirmed by another, so that its kink stands beside the window, unless the window
    /// drifts there.
    bool is_refuted(const Run& run) const {
        for (std::size_t i = run.last + 1; i < size(); ++i) {
            if (verdicts_[i].verdict != Verdict::pre_asymptotic || !orders_[i])
                continue;
            if (i != run.last + 1 || i + 1 != size())
                return true;
            const double step = *orders_[i] - *orders_[run.last];
            const double drift = *orders_[run.last] - *orders_[run.first + 1];
            if (drift * step > tuning.drift_part * step * step)
                return true;
        }
        return false;
    }

    /// Says of rows that are coarser than the window, or of all where none shows the order that all
    /// levels determine, what keeps them from it.
    void tell_from_last(bool is_asymptotic) {
        for (std::size_t i = 0; i < size(); ++i) {
            const bool had_its_window = !is_asymptotic && run_;
            const bool is_before = !is_asymptotic || i < run_->first;
            if ((verdicts_[i].verdict == Verdict::asymptotic ||
                 verdicts_[i].verdict == Verdict::pre_asymptotic) &&
                (had_its_window || (is_before && !may_be_last(std::max<std::size_t>(i, 1)))))
                verdicts_[i] = {Verdict::pre_asymptotic, reason_before(i)};
        }
        if (!is_asymptotic)
            run_.reset();
    }

    /// Of a row that is coarser than the window, or would be.
    std::string reason_before(std::size_t i) const {
        const auto& own = orders_[std::max<std::size_t>(i, 1)];
        const std::string order = own ? fmt::format("order {:.2f}", *own) : std::string("no order");
        return options_.order->determined
                   ? fmt::format("{}; that of the end is {:.2f} ± {:.2f}", order,
                                 options_.order->value, options_.order->half_width())
                   : fmt::format("{} here, and that of the end is not determined: {}", order,
                                 options_.order->status);
    }

    std::string reason_within(const Run& run) const {
        const auto* last = options_.order;
        if (last == nullptr || !last->determined ||
            (run.order >= last->low && run.order <= last->high))
            return fmt::format("order {:.2f} over the rows that agree", run.order);
        const double near = std::max(options_.tolerance * last->value, last->half_width() / 2);
        return fmt::format("order {:.2f} over {} the {:.2f} ± {:.2f} that all levels determine",
                           run.order,
                           std::abs(run.order - last->value) <= near
                               ? "the rows that agree, near"
                               : "these rows, which their deviations leave open to be",
                           last->value, last->half_width());
    }

    RowVerdict alone(double order, bool only_order) const {
        if (order < -tuning.standstill)
            return {Verdict::diverging,
                    fmt::format("the error grows under refinement, order {:.2f}", order)};
        if (order <= tuning.standstill)
            return {Verdict::floor, fmt::format("the error does not change, order {:.2f}", order)};
        if (options_.expected_order)
            return {Verdict::pre_asymptotic, fmt::format("order {:.2f}, expected is {:.2f}", order,
                                                         *options_.expected_order)};
        if (only_order)
            return {Verdict::pre_asymptotic,
                    fmt::format("order {:.2f}, which no other row confirms", order)};
        return {Verdict::pre_asymptotic, "the orders do not agree"};
    }

    void judge_without_window() {
        const auto known = std::count_if(orders_.begin(), orders_.end(),
                                         [](const auto& order) { return order.has_value(); });
        for (std::size_t i = 0; i < size(); ++i)
            verdicts_.push_back(
                orders_[i] ? alone(*orders_[i], known == 1)
                : size() == 1
                    ? RowVerdict{Verdict::pre_asymptotic, "one level alone shows no order"}
                    : RowVerdict{Verdict::pre_asymptotic,
                                 "not finer than the row before in all that changes"});
        // The first level is one end of the pair that is judged in the second.
        if (size() > 1 && orders_[1])
            verdicts_[0] = verdicts_[1];
        if (options_.order != nullptr && options_.order->levels_off)
            tell_of_floor();
    }

    /// Of rows whose error goes to a constant: those at the end whose orders fall from one to the
    /// next.
    void tell_of_floor() {
        for (std::size_t i = size() - 1; i > 1; --i) {
            if (!orders_[i] || !orders_[i - 1] ||
                !(*orders_[i] < (1 - options_.tolerance) * *orders_[i - 1]))
                return;
            if (verdicts_[i].verdict == Verdict::pre_asymptotic)
                verdicts_[i] = {Verdict::floor,
                                fmt::format("a floor begins to show, order {:.2f} after {:.2f}",
                                            *orders_[i], *orders_[i - 1])};
        }
    }

    std::vector<Level> levels_;
    std::vector<std::optional<double>> orders_;
    std::vector<double> slack_; // of the orders
    const VerdictOptions& options_;
    std::optional<Run> run_;
    std::vector<RowVerdict> verdicts_;
};

/// Levels that stand off a line on which the neighbours on both sides lie: the order into one and
/// the order out of it depart from the order past it, one up and one down, and two more orders
/// agree with that.
std::vector<bool> outliers_of(const std::vector<Level>& levels, double tolerance) {
    std::vector<bool> out(levels.size(), false);
    const auto [orders, deviations] = orders_of(levels);
    for (std::size_t i = 1; i + 1 < levels.size(); ++i) {
        const Refinement past[] = {levels[i - 1].mean, levels[i + 1].mean};
        const auto across = observed_orders(past)[1];
        if (out[i - 1] || !across || !orders[i] || !orders[i + 1] || *across <= tuning.standstill)
            continue;
        const double into = *orders[i] - *across;
        const double out_of = *orders[i + 1] - *across;
        const double slack =
            std::max(tolerance * *across, std::max(deviations[i], deviations[i + 1]));
        if (into * out_of >= 0 || std::min(std::abs(into), std::abs(out_of)) < 2 * slack)
            continue;
        std::size_t confirmed = 0;
        bool denied = false;
        for (std::size_t k = 1; k < levels.size(); ++k)
            if (k != i && k != i + 1 && orders[k]) {
                const bool near = std::abs(*orders[k] - *across) <= slack;
                confirmed += near ? 1 : 0;
                denied = denied || (!near && (k + 1 == i || k == i + 2));
            }
        out[i] = confirmed >= 2 && !denied;
    }
    return out;
}

std::string dominant_term(const ForecastRow& row) {
    constexpr double alike = 0.1;
    if (std::abs(row.spatial - row.temporal) <= alike * row.spatial)
        return "the two terms are alike";
    return row.dominant == Dominant::space ? "the h term dominates" : "the dt term dominates";
}

RowVerdict by_model(const LadderForecast& view, std::size_t i, std::size_t rows) {
    const auto& row = view.rows[i];
    if (row.dominant == Dominant::cancellation)
        return {Verdict::cancellation,
                fmt::format("the h term {:.1e} and the dt term {:.1e} cancel in part", row.spatial,
                            row.temporal)};
    if (view.asymptotic_from && i >= view.asymptotic_from->row)
        return {Verdict::asymptotic, dominant_term(row) + fmt::format(", order {:.2f} to the end",
                                                                      view.asymptotic_order)};
    std::string reason = dominant_term(row) + fmt::format(" here; in the end the order is {:.2f}",
                                                          view.asymptotic_order);
    if (view.asymptotic_from && view.asymptotic_from->row >= rows)
        reason += fmt::format(", from h = {:.1e}, dt = {:.1e} on", view.asymptotic_from->h,
                              view.asymptotic_from->dt);
    return {Verdict::pre_asymptotic, reason};
}

/// Rows of which the model speaks true take its verdict.
void prefer_model(const std::vector<Level>& in_line, const VerdictOptions& options,
                  std::vector<RowVerdict>& verdicts) {
    std::vector<Refinement> levels;
    levels.reserve(in_line.size());
    for (const auto& level : in_line)
        levels.push_back(level.mean);
    for (const auto& record : levels)
        if (!(record.h > 0 && record.dt > 0 && std::isfinite(record.h * record.dt)))
            return;
    const auto view = forecast(*options.model, levels, options.tolerance);
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (std::abs(levels[i].error - view.rows[i].error) <=
            tuning.model_tolerance * levels[i].error)
            verdicts[i] = by_model(view, i, levels.size());
}

RowVerdict unusable(const Refinement& record) {
    const double error = record.error;
    if (!std::isnan(error) && !record.is_resolved())
        return {Verdict::unresolved,
                fmt::format("uncertain by {:.1e} of itself", record.uncertainty)};
    if (error == 0)
        return {Verdict::exact, "the error is zero"};
    if (std::isnan(error))
        return {Verdict::failed, "the error is not a number"};
    return {Verdict::failed, error < 0 ? "the error is negative" : "the error is infinite"};
}

/// Levels of which the same is refined from each to the next, and the window among them.
std::vector<RowVerdict> judge_sweep(const std::vector<Level>& levels, const VerdictOptions& options,
                                    std::optional<LadderVerdict::Window>& window) {
    const auto out = outliers_of(levels, options.tolerance);
    std::vector<std::size_t> kept; // positions in levels
    std::vector<Level> in_line;
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (!out[i]) {
            kept.push_back(i);
            in_line.push_back(levels[i]);
        }
    const Pairwise judged(in_line, options);
    if (const auto& run = judged.run())
        window = {levels[kept[run->first]].rows.front(), levels[kept[run->last]].rows.back(),
                  run->order};
    auto of_kept = judged.verdicts();
    if (options.model != nullptr)
        prefer_model(in_line, options, of_kept);
    std::vector<RowVerdict> verdicts(levels.size(),
                                     {Verdict::outlier, "out of line with the rows beside it"});
    for (std::size_t k = 0; k < kept.size(); ++k)
        verdicts[kept[k]] = std::move(of_kept[k]);
    return verdicts;
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
    case Verdict::outlier:
        return "outlier";
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
    result.orders.resize(ladder.size());
    const auto levels = levels_of(ladder, options.sigma);
    if (levels.empty())
        return result;
    const auto sweeps = sweeps_of(levels);
    std::vector<bool> is_judged(levels.size(), false);
    for (const auto& sweep : sweeps) {
        std::vector<Level> of_sweep;
        of_sweep.reserve(sweep.size());
        for (const std::size_t i : sweep)
            of_sweep.push_back(levels[i]);
        const auto orders = orders_of(of_sweep).values;
        const auto verdicts = judge_sweep(of_sweep, options, result.window);
        // A level of two sweeps has the order and the verdict of the first.
        for (std::size_t k = 0; k < sweep.size(); ++k) {
            const std::size_t i = sweep[k];
            if (is_judged[i])
                continue;
            is_judged[i] = true;
            result.orders[levels[i].rows.front()] = orders[k];
            for (const std::size_t row : levels[i].rows)
                result.rows[row] = verdicts[k];
        }
    }
    if (sweeps.size() > 1)
        result.window.reset();
    return result;
}

} // namespace tvbeam
