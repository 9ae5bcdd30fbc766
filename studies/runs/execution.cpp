#include "studies/runs/execution.hpp"

#include "studies/runs/parallel.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

namespace tvbeam {

std::function<bool(std::int64_t)> Execution::steps_of(const Method& method,
                                                      const Rung& rung) const {
    const double step_work =
        work_of(method, rung) / static_cast<double>(std::max<std::int64_t>(rung.steps, 1));
    return [*this, step_work](std::int64_t steps) {
        return advance(static_cast<double>(steps) * step_work);
    };
}

RungResult run_or_find(const Series& series, std::size_t index, const RunCall& run,
                       const Execution& execution) {
    const Rung& rung = series.rungs[index];
    const auto made = [&] {
        return run({index, rung, series.final_time, series.method, series.measures,
                    execution.steps_of(series.method, rung)});
    };
    if (execution.finished == nullptr)
        return made();
    if (auto kept = execution.finished->find(series, index)) {
        execution.expect(-work_of(series.method, rung));
        return *std::move(kept);
    }
    if (execution.only_finished)
        return {.rung = rung, .status = RungStatus::interrupted, .reason = not_made};
    RungResult result = made();
    if (result.status != RungStatus::interrupted)
        execution.finished->add(series, index, result);
    return result;
}

std::vector<RungResult> run_series(const Series& series, const RunCall& run,
                                   const Execution& execution) {
    std::vector<std::size_t> all(series.rungs.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return run_series(series, all, run, execution);
}

std::vector<RungResult> run_series(const Series& series, const std::vector<std::size_t>& indices,
                                   const RunCall& run, const Execution& execution) {
    std::vector<double> costs;
    costs.reserve(indices.size());
    for (const std::size_t index : indices)
        costs.push_back(work_of(series.method, series.rungs[index]));
    std::vector<RungResult> results(indices.size());
    for_each_longest_first(costs, execution.jobs, [&](std::size_t i) {
        results[i] = run_or_find(series, indices[i], run, execution);
    });
    return results;
}

std::any make_or_find(const Parts& parts, std::size_t index, const Execution& execution) {
    const double work = parts.work(index);
    if (execution.finished != nullptr)
        if (std::any kept = execution.finished->find_part(parts.study, index); kept.has_value()) {
            execution.expect(-work);
            return kept;
        }
    if (execution.only_finished || !execution.advance(0.0))
        return {};
    std::any result = parts.make(index);
    if (execution.finished != nullptr)
        execution.finished->add_part(parts.study, index, result);
    execution.advance(work);
    return result;
}

void run_parts(const Parts& parts, const Execution& execution,
               const std::function<void(std::size_t, std::any)>& take) {
    std::vector<double> costs;
    costs.reserve(parts.count);
    for (std::size_t i = 0; i < parts.count; ++i)
        costs.push_back(parts.work(i));
    std::mutex one_at_a_time;
    for_each_longest_first(costs, execution.jobs, [&](std::size_t i) {
        std::any result = make_or_find(parts, i, execution);
        const std::scoped_lock lock(one_at_a_time);
        if (result.has_value())
            take(i, std::move(result));
    });
}

} // namespace tvbeam
