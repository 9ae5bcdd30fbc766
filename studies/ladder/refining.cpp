#include "studies/ladder/refining.hpp"

#include "studies/data/refined_widths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

/// Of an error the order along the ladder, of a value the limit.
const OrderInterval& interval_of(const ColumnAnalysis& column) {
    return column.is_value ? column.limit->limit : column.by_width.front();
}

/// What the next level will need, as the last two have it.
double forecast_seconds(const std::vector<RungResult>& rungs) {
    const RungResult& last = rungs.back();
    const RungResult& before = rungs[rungs.size() - 2];
    // One that was kept by an earlier version may lack the wall's clock.
    const bool by_one_clock = last.wall_clock.has_value() == before.wall_clock.has_value();
    const double growth = by_one_clock ? last.seconds_taken() / before.seconds_taken()
                                       : last.seconds / before.seconds;
    return last.seconds_taken() * (growth > 1.0 && std::isfinite(growth) ? growth : 1.0);
}

} // namespace

DataAnalysis analysis_of(const Series& series, const std::vector<RungResult>& rungs) {
    DataFile data{
        .name = series.study, .widths = {}, .errors = {}, .values = {}, .sigma = {}, .remarks = {}};
    const auto add_width = [&](const std::string& name, const auto& width) {
        DataColumn column{name, {}};
        for (const auto& rung : rungs)
            column.numbers.push_back(width(rung.rung));
        data.widths.push_back(std::move(column));
    };
    if (rungs.front().rung.has_mesh())
        add_width("h", [](const Rung& rung) { return rung.h(); });
    if (rungs.front().rung.has_steps())
        add_width("dt", [](const Rung& rung) { return rung.dt; });
    // What is refined first: the order is one in that.
    if (leading_width(data.widths) > 0)
        std::swap(data.widths.front(), data.widths.back());
    for (std::size_t k = 0; k < series.measures.size(); ++k) {
        const Measure& measure = series.measures[k];
        DataColumn column{measure.of_orders(), {}};
        for (const auto& rung : rungs) {
            const double figure =
                rung.errors.empty() ? std::numeric_limits<double>::quiet_NaN() : rung.errors[k];
            column.numbers.push_back(measure.squared ? std::sqrt(figure) : figure);
        }
        column.units = units_of(rungs, k, measure.is_value);
        (measure.is_value ? data.values : data.errors).push_back(std::move(column));
    }
    return analyse(data);
}

std::vector<Rung> added_levels(const LadderBlock& ladder) {
    std::vector<Rung> rungs = ladder.rungs;
    const auto most = static_cast<std::size_t>(ladder.until->most.value_or(most_levels));
    while (ladder.until->adds && rungs.size() < most)
        if (const auto next = ladder.next(rungs))
            rungs.push_back(*next);
        else
            break;
    rungs.erase(rungs.begin(), rungs.begin() + static_cast<std::ptrdiff_t>(ladder.rungs.size()));
    return rungs;
}

namespace {

bool is_wanted(const Until& until, const Measure& measure) {
    return (measure.is_value ? until.limit : until.order).has_value();
}

std::vector<std::string> wanted_of(const Until& until, const Series& series) {
    std::vector<std::string> wanted;
    for (const auto& measure : series.measures)
        if (is_wanted(until, measure))
            wanted.push_back(measure.root());
    return wanted;
}

/// What tells a level from the others, greater where it is finer.
using Level = std::pair<std::int64_t, double>;

Level level_of(const RungResult& run) {
    return {run.rung.elements, -run.rung.dt};
}

/// The levels that show something of measure k, each once.
std::set<Level> levels_of(const Measure& measure, std::size_t k,
                          const std::vector<RungResult>& rungs) {
    std::set<Level> levels;
    for (const auto& run : rungs)
        if (shows(run, measure, k))
            levels.insert(level_of(run));
    return levels;
}

} // namespace

std::vector<std::string> not_known(const Until& until, const Series& series,
                                   const std::vector<RungResult>& rungs) {
    std::optional<DataAnalysis> now;
    std::map<Level, DataAnalysis> without; // mostly one, of the finest level
    const auto knows = [&](double wanted, std::size_t k) {
        const auto levels = levels_of(series.measures[k], k, rungs);
        if (levels.size() < least_known_levels)
            return false;
        if (!now)
            now = analysis_of(series, rungs);
        const Level finest = *levels.rbegin();
        auto before = without.find(finest);
        if (before == without.end()) {
            auto others = rungs;
            std::erase_if(others, [&](const RungResult& run) { return level_of(run) == finest; });
            before = without.emplace(finest, analysis_of(series, others)).first;
        }
        return !vanishes_at_the_finest(*now, now->columns[k]) &&
               is_known(wanted, interval_of(now->columns[k]),
                        interval_of(before->second.columns[k]));
    };
    std::vector<std::string> open;
    for (std::size_t k = 0; k < series.measures.size(); ++k) {
        const Measure& measure = series.measures[k];
        const auto& wanted = measure.is_value ? until.limit : until.order;
        if (wanted && !knows(*wanted, k))
            open.push_back(measure.root());
    }
    return open;
}

Refined refine(const LadderBlock& block, Series& series, std::vector<RungResult>& rungs,
               const RunCall& run, const Execution& execution) {
    const Until& until = *block.until;
    const auto levels = until.adds ? until.most : std::optional<std::int64_t>(0);
    while (true) {
        if (std::any_of(rungs.begin(), rungs.end(),
                        [](const RungResult& one) { return one.status != RungStatus::ok; }))
            return {RefiningEnd::run_ended, wanted_of(until, series)};
        const auto open = not_known(until, series, rungs);
        if (open.empty())
            return {RefiningEnd::known};
        if (levels && rungs.size() >= static_cast<std::size_t>(*levels))
            return {RefiningEnd::levels, open};
        if (until.seconds && seconds_of(rungs) + forecast_seconds(rungs) > *until.seconds)
            return {RefiningEnd::seconds, open};
        const auto next = block.next(series.rungs);
        if (!next)
            return {RefiningEnd::finest, open};
        series.rungs.push_back(*next);
        execution.expect(work_of(series.method, *next));
        rungs.push_back(run_or_find(series, rungs.size(), run, execution));
    }
}

} // namespace tvbeam
