#include "studies/work_precision/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <span>

#include <sys/resource.h>

namespace tvbeam {

namespace {

/// A run shorter than this finds the caches as other runs left them: one that does not count goes
/// before each that does. Unit: s.
constexpr double quick = 1e-3;
/// A run is timed as often as it takes to fill so many seconds, by its warm-up, and so often at
/// least. Its times have no say in that: to stop where they happen to agree makes quartiles narrow.
constexpr double enough_seconds = 0.5;
constexpr int least_runs = 5;
/// Of a core, for times that can be compared.
constexpr double least_share = 0.9;
/// A relative change of an error from run to run that is one of sums in another order.
constexpr double same_error_again = 1e-6;
constexpr int first_decade = 2; // 1e-2, or one that is above it and below errors of every scheme
constexpr int least_decade = -12;
constexpr int last_decade = 9;

std::string study_of(const TimedScheme& scheme) {
    return "work_precision." + scheme.name;
}

/// Of this process, and of those that it has waited for.
double processor_seconds() {
    double seconds = 0.0;
    for (const auto whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(whose, &usage);
        for (const timeval& part : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
    }
    return seconds;
}

/// One rung of one scheme, and its timed runs so far.
struct Contestant {
    std::size_t scheme;
    std::size_t run;
    double warm_up = 0.0;
    std::vector<double> seconds = {};
    std::vector<double> shown = {}; ///< by the clock, of these runs and of those before
    std::vector<PrintedDigits> printed = {};
    double clock_step = 0.0;
    double greatest_change = 0.0; ///< of an error, from its first run to those that are timed
    std::size_t changed = 0;      ///< which one

    /// Of so many rounds, those that it takes part in lie evenly among them: a machine that slows
    /// down slows all alike.
    [[nodiscard]] bool takes_part(int round, int rounds) const {
        const int runs = static_cast<int>(std::clamp(std::ceil(enough_seconds / warm_up),
                                                     std::min<double>(least_runs, rounds),
                                                     static_cast<double>(rounds)));
        return (round + 1) * runs / rounds > round * runs / rounds;
    }
};

using Contestants = std::span<Contestant>;

/// The greatest clock_step of contestants becomes that which all their times have in common, where
/// it is more: of many, a tick is seen that those of one do not show. One value shows none.
void raise_clock_steps(Contestants contestants) {
    std::vector<double> shown;
    double greatest = 0.0;
    for (const auto& one : contestants) {
        shown.insert(shown.end(), one.shown.begin(), one.shown.end());
        greatest = std::max(greatest, one.clock_step);
    }
    if (std::ranges::adjacent_find(shown, std::not_equal_to()) == shown.end())
        return;
    if (const double step = clock_step_of(shown, greatest); step > greatest)
        for (auto& one : contestants)
            one.clock_step = step;
}

/// The clock_step of each becomes the unit of the last digit of its times, where they are printed:
/// those of one scheme all alike.
void take_printed_units(Contestants of_a_scheme) {
    std::vector<double> shown;
    std::vector<PrintedDigits> printed;
    for (const auto& one : of_a_scheme) {
        shown.insert(shown.end(), one.shown.begin(), one.shown.end());
        printed.insert(printed.end(), one.printed.begin(), one.printed.end());
    }
    const auto units = printed_units(shown, printed);
    auto unit = units.begin();
    for (auto& one : of_a_scheme)
        for (std::size_t i = 0; i < one.shown.size() && unit != units.end(); ++i)
            one.clock_step = std::max(one.clock_step, *unit++);
}

/// By what they show. Schemes may be programs with clocks of their own.
void set_clock_steps(std::vector<Contestant>& contestants) {
    for (auto begin = contestants.begin(); begin != contestants.end();) {
        const auto end = std::find_if(begin, contestants.end(), [&](const Contestant& other) {
            return other.scheme != begin->scheme;
        });
        take_printed_units({begin, end});
        raise_clock_steps({begin, end});
        begin = end;
    }
    raise_clock_steps(contestants);
}

std::string text_of(const Rung& rung) {
    return rung.name([](double dt) { return fmt::format("{:g}", dt); });
}

class Race {
public:
    Race(const WorkPrecisionBlock& block, const StudiedSolver& solver, const Execution& execution,
         double one_run_above)
        : block_(block), all_(series_of(block)), execution_(execution),
          one_run_above_(one_run_above), measures_(solver.measures_for_nothing) {
        run_ = [this, run = solver.run](const RunTask& task) {
            RungResult result = run(task);
            interrupted_ = interrupted_ || result.status == RungStatus::interrupted;
            return result;
        };
    }

    [[nodiscard]] bool interrupted() const { return interrupted_; }

    std::vector<SchemeRuns> take() {
        for (std::size_t k = 0; k < block_.schemes.size(); ++k)
            enter(k);
        for (int round = 0; round < block_.runs; ++round)
            for (auto& contestant : contestants_)
                if (!is_long(contestant) && contestant.takes_part(round, block_.runs))
                    time(contestant);
        set_clock_steps(contestants_);
        for (const auto& contestant : contestants_) {
            SchemeRuns& scheme = result_[contestant.scheme];
            if (scheme.runs[contestant.run].status != RungStatus::ok)
                continue;
            scheme.timings[contestant.run] = timing(contestant);
        }
        for (std::size_t k = 0; k < result_.size(); ++k)
            add_unsteady(k);
        return std::move(result_);
    }

private:
    /// Its warm-up is the only run.
    [[nodiscard]] bool is_long(const Contestant& contestant) const {
        return contestant.warm_up > one_run_above_;
    }

    /// None of what was to be timed and was not, as an interruption came before.
    [[nodiscard]] std::optional<Timing> timing(const Contestant& contestant) const {
        const auto seconds =
            is_long(contestant) ? std::vector{contestant.warm_up} : contestant.seconds;
        return seconds.empty() ? std::nullopt
                               : std::optional(timing_of(seconds, contestant.clock_step));
    }

    /// Of the errors of a scheme that are others where they are timed, the one that differs most.
    void add_unsteady(std::size_t scheme) {
        const Contestant* most = nullptr;
        for (const auto& one : contestants_)
            if (one.scheme == scheme && one.greatest_change > same_error_again &&
                (most == nullptr || one.greatest_change > most->greatest_change))
                most = &one;
        if (most != nullptr)
            result_[scheme].unsteady = fmt::format(
                "{}: errors differ from run to run, {} at {} by a part of {:.2g}; those of the "
                "first run are shown.",
                block_.schemes[scheme].name, block_.norms[most->changed].name,
                text_of(all_[scheme].rungs[most->run]), most->greatest_change);
    }

    /// How far an error is from that of the first run, as a part of the larger one; 0 where both
    /// are rounding beside the scheme's largest error.
    [[nodiscard]] double change(const Contestant& contestant, std::size_t k, double error) const {
        constexpr double rounding = 1e-12;
        const auto& runs = result_[contestant.scheme].runs;
        double largest = 0.0;
        for (const auto& run : runs)
            if (k < run.errors.size())
                largest = std::max(largest, run.errors[k]);
        if (k >= runs[contestant.run].errors.size()) // it failed in an earlier round
            return 0.0;
        const double first = runs[contestant.run].errors[k];
        const double difference = std::abs(error - first);
        return difference > rounding * largest ? difference / std::max(error, first) : 0.0;
    }

    /// A run whose time is wanted.
    RungResult run_timed(Contestant& contestant) {
        static const std::vector<Measure> nothing;
        const Series& series = all_[contestant.scheme];
        const Rung& rung = series.rungs[contestant.run];
        RungResult result =
            run_({contestant.run, rung, series.final_time, series.method,
                  measures_ ? series.measures : nothing, execution_.steps_of(series.method, rung)});
        if (result.status == RungStatus::ok) {
            for (std::size_t k = 0; k < result.errors.size(); ++k)
                if (const double found = change(contestant, k, result.errors[k]);
                    found > contestant.greatest_change) {
                    contestant.greatest_change = found;
                    contestant.changed = k;
                }
            contestant.shown.push_back(result.seconds);
            contestant.printed.push_back(result.printed_seconds);
        }
        return result;
    }

    void enter(std::size_t scheme) {
        SchemeRuns& runs = result_.emplace_back();
        for (std::size_t level = 0; level < all_[scheme].rungs.size(); ++level) {
            runs.runs.push_back(run_or_find(all_[scheme], level, run_, execution_));
            runs.timings.emplace_back();
            RungResult& measured = runs.runs.back();
            if (measured.status != RungStatus::ok)
                continue;
            Contestant contestant{scheme, level};
            const RungResult warm_up = run_timed(contestant);
            if (warm_up.status != RungStatus::ok) {
                fail(measured, warm_up);
                continue;
            }
            measured.counters = warm_up.counters;
            contestant.warm_up = warm_up.seconds;
            contestants_.push_back(std::move(contestant));
        }
    }

    void time(Contestant& contestant) {
        if (contestant.warm_up < quick)
            run_timed(contestant);
        const RungResult timed = run_timed(contestant);
        if (timed.status == RungStatus::ok)
            contestant.seconds.push_back(timed.seconds);
        else
            fail(result_[contestant.scheme].runs[contestant.run], timed);
    }

    /// A run that was measured and fails where it is timed is one that failed.
    static void fail(RungResult& measured, const RungResult& timed) {
        if (timed.status != RungStatus::failed)
            return;
        const Rung rung = measured.rung;
        measured = timed;
        measured.rung = rung;
        measured.reason = "timed again, it failed: " + timed.reason;
    }

    const WorkPrecisionBlock& block_;
    const std::vector<Series> all_; ///< one a scheme
    RunCall run_;
    const Execution& execution_;
    double one_run_above_;
    bool measures_;
    bool interrupted_ = false;
    std::vector<SchemeRuns> result_;
    std::vector<Contestant> contestants_;
};

/// Norm k along the ladder of one scheme.
std::vector<TimedError> rows_of(const SchemeRuns& scheme, std::size_t k) {
    std::vector<TimedError> rows;
    for (std::size_t i = 0; i < scheme.runs.size(); ++i) {
        const auto& errors = scheme.runs[i].errors;
        rows.push_back({.error = errors.empty() || !has_time(scheme.timings[i])
                                     ? std::numeric_limits<double>::quiet_NaN()
                                     : errors[k],
                        .timing = scheme.timings[i].value_or(Timing{})});
    }
    return rows;
}

double smallest_error(const std::vector<std::vector<TimedError>>& schemes) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& rows : schemes)
        for (const auto& row : rows)
            if (row.error > 0.0)
                smallest = std::min(smallest, row.error);
    return smallest;
}

/// The decade of the largest power of ten that every scheme has an error above.
int first_decade_of(const std::vector<std::vector<TimedError>>& schemes) {
    double common = std::numeric_limits<double>::infinity();
    for (const auto& rows : schemes) {
        double largest = 0.0;
        for (const auto& row : rows)
            if (std::isfinite(row.error))
                largest = std::max(largest, row.error);
        common = std::min(common, largest);
    }
    return common > 0.0 && std::isfinite(common)
               ? std::clamp(-static_cast<int>(std::floor(std::log10(common))), least_decade,
                            first_decade)
               : first_decade;
}

/// The errors at which schemes are compared, from large to small.
std::vector<ReachedError> errors_to_reach(const std::vector<std::vector<TimedError>>& schemes,
                                          const std::vector<double>& targets) {
    const double smallest = smallest_error(schemes);
    std::vector<ReachedError> errors;
    const auto add = [&](double error, bool target) {
        const auto same = std::find_if(errors.begin(), errors.end(),
                                       [&](const ReachedError& one) { return one.error == error; });
        if (same == errors.end())
            errors.push_back({error, target, {}, {}});
        else
            same->target = same->target || target;
    };
    for (int decade = first_decade_of(schemes);; ++decade) {
        const double error = std::pow(10.0, -decade);
        if (decade > last_decade && !(error >= smallest))
            break;
        add(error, false);
    }
    for (const double target : targets)
        add(target, true);
    std::sort(errors.begin(), errors.end(),
              [](const ReachedError& a, const ReachedError& b) { return a.error > b.error; });
    return errors;
}

void compare_all(ReachedError& reached) {
    for (std::size_t i = 0; i < reached.times.size(); ++i)
        for (std::size_t j = i + 1; j < reached.times.size(); ++j)
            if (reached.times[i] && reached.times[j]) {
                const Comparison times = compare(*reached.times[i], *reached.times[j]);
                reached.comparisons.push_back({.faster = times.first_is_faster ? i : j,
                                               .slower = times.first_is_faster ? j : i,
                                               .times = times});
            }
}

/// A sentence for every row whose error is larger than that of the row before it.
void add_rises(std::vector<std::string>& remarks, const std::string& norm,
               const TimedScheme& scheme, const std::vector<TimedError>& rows) {
    std::optional<std::size_t> before; // the last row that has an error
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (std::isnan(rows[i].error))
            continue;
        if (before && rows[i].error > rows[*before].error)
            remarks.push_back(scheme.name + ": " + norm + " rises from " +
                              text_of(scheme.rungs[*before]) + " to " + text_of(scheme.rungs[i]) +
                              "; an error counts as reached from where no finer row exceeds it.");
        before = i;
    }
}

/// A sentence for every row whose clock stood still, in some runs or all.
void add_standing_clocks(std::vector<std::string>& remarks, const TimedScheme& scheme,
                         const SchemeRuns& runs) {
    for (std::size_t i = 0; i < runs.runs.size(); ++i)
        if (runs.timings[i] && !has_time(runs.timings[i]))
            remarks.push_back(fmt::format(
                "{}: the clock shows 0 s {}at {}; it is too coarse for this row, which is compared "
                "with none.",
                scheme.name,
                runs.timings[i]->at_zero < runs.timings[i]->runs
                    ? fmt::format("in {} of {} runs ", runs.timings[i]->at_zero,
                                  runs.timings[i]->runs)
                    : "",
                text_of(scheme.rungs[i])));
}

} // namespace

std::vector<Series> series_of(const WorkPrecisionBlock& block) {
    std::vector<Series> all;
    for (const auto& scheme : block.schemes)
        all.push_back(
            {study_of(scheme), block.final_time, scheme.method, block.norms, scheme.rungs});
    return all;
}

bool has_time(const std::optional<Timing>& timing) {
    return timing && timing->min > 0.0;
}

std::string busy_remark(double processor_seconds, double wall_clock_seconds) {
    const double share = processor_seconds / wall_clock_seconds;
    if (share >= least_share)
        return {};
    return "The machine was busy: the runs had " + std::to_string(std::lround(100.0 * share)) +
           " % of a core. Long runs lose more to other programs than short ones, so that these "
           "ratios are not to be trusted: time it again on an idle machine.";
}

std::uint64_t node_steps(const Rung& rung) {
    std::uint64_t product = 0;
    return __builtin_mul_overflow(rung.elements, rung.steps, &product)
               ? std::numeric_limits<std::uint64_t>::max()
               : product;
}

WorkPrecisionResult run_work_precision(const WorkPrecisionBlock& block, const StudiedSolver& solver,
                                       const Execution& execution, double one_run_above) {
    WorkPrecisionResult result;
    const double processor = processor_seconds();
    const auto start = std::chrono::steady_clock::now();
    Race race(block, solver, execution, one_run_above);
    result.schemes = race.take();
    result.interrupted = race.interrupted();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.busy_remark = busy_remark(processor_seconds() - processor, elapsed.count());
    result.norms = costs_of(block, result.schemes);
    return result;
}

std::vector<NormCosts> costs_of(const WorkPrecisionBlock& block,
                                const std::vector<SchemeRuns>& schemes) {
    std::vector<NormCosts> all;
    for (std::size_t k = 0; k < block.norms.size(); ++k) {
        NormCosts costs{block.norms[k], {}, {}};
        std::vector<std::vector<TimedError>> ladders;
        for (std::size_t scheme = 0; scheme < schemes.size(); ++scheme) {
            ladders.push_back(rows_of(schemes[scheme], k));
            add_rises(costs.remarks, costs.norm.name, block.schemes[scheme], ladders.back());
            if (k == 0)
                add_standing_clocks(costs.remarks, block.schemes[scheme], schemes[scheme]);
            if (k == 0 && !schemes[scheme].unsteady.empty())
                costs.remarks.push_back(schemes[scheme].unsteady);
        }
        const auto targets = block.targets.find(costs.norm.name);
        costs.errors = errors_to_reach(
            ladders, targets == block.targets.end() ? std::vector<double>{} : targets->second);
        for (auto& reached : costs.errors) {
            for (const auto& rows : ladders)
                reached.times.push_back(time_to_reach(rows, reached.error));
            compare_all(reached);
        }
        all.push_back(std::move(costs));
    }
    return all;
}

} // namespace tvbeam
