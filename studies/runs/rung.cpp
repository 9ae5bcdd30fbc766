#include "studies/runs/rung.hpp"

#include "studies/runs/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace tvbeam {

RungResult run_rung(const Scene& scene, const Scheme& scheme, const std::vector<Norm>& norms,
                    double final_time, const Rung& rung, const ProblemData& data,
                    const Execution& execution) {
    const double step_work = work_of(scheme, rung) / static_cast<double>(rung.steps);
    const auto start = std::chrono::steady_clock::now();
    const RunResult run =
        tvbeam::run({.beam = scene.beam,
                     .mesh = scene.mesh.with(rung.elements),
                     .scheme = scheme,
                     .final_time = final_time,
                     .steps = rung.steps,
                     .norms = norms,
                     .advance =
                         [&](std::int64_t steps) {
                             return execution.advance(static_cast<double>(steps) * step_work);
                         }},
                    data);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {rung,         run.status, run.reason,       elapsed.count(),
            run.counters, run.errors, run.uncertainties};
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
    if (result.status != RunStatus::interrupted)
        execution.finished->add(study, index, result);
    return result;
}

std::vector<RungResult> run_rungs(const std::string& study, const Scene& scene,
                                  const std::vector<Norm>& norms, double final_time,
                                  const std::vector<Rung>& rungs, const ProblemData& data,
                                  const Execution& execution) {
    std::vector<double> costs;
    costs.reserve(rungs.size());
    for (const auto& rung : rungs)
        costs.push_back(work_of(scene.scheme, rung));
    std::vector<RungResult> results(rungs.size());
    for_each_longest_first(costs, execution.jobs, [&](std::size_t i) {
        results[i] = run_or_find(study, i, execution, costs[i], [&] {
            return run_rung(scene, scene.scheme, norms, final_time, rungs[i], data, execution);
        });
        // What the norms show of the reference against itself is the rounding of its evaluation.
        if (scene.reference && scene.reference->is(rungs[i])) {
            std::fill(results[i].errors.begin(), results[i].errors.end(), 0.0);
            results[i].uncertainties.clear();
        }
    });
    return results;
}

std::vector<Refinement> records_of(const std::vector<RungResult>& rungs, std::size_t k) {
    std::vector<Refinement> records;
    records.reserve(rungs.size());
    for (const auto& rung : rungs)
        records.push_back(
            {.h = 1.0 / static_cast<double>(rung.rung.elements),
             .dt = rung.rung.dt,
             .error =
                 rung.errors.empty() ? std::numeric_limits<double>::quiet_NaN() : rung.errors[k],
             .seconds = rung.seconds,
             .uncertainty = rung.uncertainties.empty() ? 0.0 : rung.uncertainties[k]});
    return records;
}

std::vector<Refinement> root_records_of(const std::vector<RungResult>& rungs, std::size_t k,
                                        const Norm& norm) {
    auto records = records_of(rungs, k);
    if (norm.squared)
        for (auto& record : records)
            record.error = std::sqrt(record.error);
    return records;
}

bool any_failed(const std::vector<RungResult>& rungs) {
    return std::any_of(rungs.begin(), rungs.end(),
                       [](const RungResult& rung) { return rung.status != RunStatus::ok; });
}

} // namespace tvbeam
