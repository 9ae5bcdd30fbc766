#include "studies/runs/execution.hpp"

#include "studies/runs/parallel.hpp"

namespace tvbeam {

std::function<bool(std::int64_t)> Execution::steps_of(const Method& method,
                                                      const Rung& rung) const {
    const double step_work = work_of(method, rung) / static_cast<double>(rung.steps);
    return [*this, step_work](std::int64_t steps) {
        return advance(static_cast<double>(steps) * step_work);
    };
}

RungResult run_or_find(const std::string& study, std::size_t index, const Execution& execution,
                       double work, const std::function<RungResult()>& run) {
    if (execution.finished == nullptr)
        return run();
    if (auto kept = execution.finished->find(study, index)) {
        execution.expect(-work);
        return *std::move(kept);
    }
    RungResult result = run();
    if (result.status != RungStatus::interrupted)
        execution.finished->add(study, index, result);
    return result;
}

std::vector<RungResult> run_series(const Series& series, const RunCall& run,
                                   const Execution& execution) {
    std::vector<double> costs;
    costs.reserve(series.rungs.size());
    for (const auto& rung : series.rungs)
        costs.push_back(work_of(series.method, rung));
    std::vector<RungResult> results(series.rungs.size());
    for_each_longest_first(costs, execution.jobs, [&](std::size_t i) {
        const Rung& rung = series.rungs[i];
        results[i] = run_or_find(series.study, i, execution, costs[i], [&] {
            return run({rung, series.final_time, series.method, series.measures,
                        execution.steps_of(series.method, rung)});
        });
    });
    return results;
}

} // namespace tvbeam
