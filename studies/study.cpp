#include "studies/study.hpp"

#include "core/run.hpp"
#include "studies/phase_remarks.hpp"

#include <algorithm>
#include <memory>

namespace tvbeam {

bool StudyResult::failed() const {
    const auto all = runs();
    return interrupted() || (stress && stress->failed()) ||
           (evolution && evolution->run.status != RunStatus::ok) ||
           std::any_of(all.begin(), all.end(),
                       [](const MeasuredRuns& study) { return any_failed(*study.runs); });
}

bool StudyResult::interrupted() const {
    const auto all = runs();
    return (stress && stress->interrupted) || (work_precision && work_precision->interrupted) ||
           (evolution && evolution->run.status == RunStatus::interrupted) ||
           std::any_of(all.begin(), all.end(), [](const MeasuredRuns& study) {
               return std::any_of(
                   study.runs->begin(), study.runs->end(),
                   [](const RungResult& run) { return run.status == RunStatus::interrupted; });
           });
}

std::vector<MeasuredRuns> StudyResult::runs() const {
    std::vector<MeasuredRuns> all;
    if (ladder)
        all.push_back({"ladder", &ladder->rungs, &scene.ladder->norms});
    if (orders)
        all.push_back({"orders", &orders->runs, &scene.orders->norms});
    if (work_precision)
        for (std::size_t k = 0; k < work_precision->schemes.size(); ++k)
            all.push_back({"work_precision." + scene.work_precision->schemes[k].name,
                           &work_precision->schemes[k].runs, &scene.work_precision->norms});
    return all;
}

namespace {

double work_of(const Scheme& scheme, const std::vector<Rung>& rungs) {
    double work = 0.0;
    for (const auto& rung : rungs)
        work += work_of(scheme, rung);
    return work;
}

/// Of a reference run, and of the two coarser ones that it may be extrapolated from.
double work_of(const ReferenceBlock& reference, double final_time) {
    return static_cast<double>(reference.elements) * final_time / reference.dt *
           (reference.richardson ? 2.0 : 1.0);
}

/// Of all studies of a scene; a contraction map and a round-off table aside.
double work_of(const Scene& scene) {
    double work = 0.0;
    if (scene.reference && !scene.norms().empty())
        work += work_of(*scene.reference, scene.longest_time());
    if (scene.ladder)
        work += work_of(scene.scheme, scene.ladder->rungs);
    if (scene.orders)
        work += work_of(scene.scheme, scene.orders->grid);
    if (scene.evolution)
        work += work_of(scene.scheme, scene.evolution->rung);
    if (scene.work_precision)
        for (const auto& timed : scene.work_precision->schemes) // with norms, to warm up, timed
            work += (scene.work_precision->runs + 2) * work_of(timed.scheme, timed.rungs);
    if (scene.stress)
        for (const auto& sweep : scene.stress->sweeps)
            for (const auto& parameters : sweep.cases)
                work += work_of(parameters);
    return work;
}

std::vector<Algorithm> algorithms_of(const Scene& scene) {
    std::vector<Algorithm> algorithms{scene.scheme.algorithm};
    if (scene.work_precision)
        for (const auto& timed : scene.work_precision->schemes)
            algorithms.push_back(timed.scheme.algorithm);
    return algorithms;
}

} // namespace

StudyResult run_study(const Scene& scene, ProblemData data, const Execution& execution) {
    require_runnable(scene, data);
    execution.expect(work_of(scene));
    StudyResult result{.scene = scene,
                       .left_out = {},
                       .remarks = {},
                       .reference = {},
                       .orders = {},
                       .ladder = {},
                       .work_precision = {},
                       .evolution = {},
                       .stress = {}};
    if (scene.stress)
        result.stress = run_stress(*scene.stress, execution);
    if (!scene.poses_problem())
        return result;
    result.remarks = phase_remarks(scene, data);
    data.resolution = std::make_shared<const Resolution>(
        resolution_of(data, algorithms_of(scene), scene.norms(), scene.longest_time()));
    if (scene.reference && !scene.norms().empty())
        result.reference = measure_against_reference(scene, scene.longest_time(), data, execution);
    result.left_out = left_out(scene, data);
    if (scene.orders)
        result.orders = run_orders(scene, *scene.orders, data, execution);
    if (scene.ladder)
        result.ladder = run_ladder(scene, *scene.ladder, data,
                                   result.orders ? &*result.orders : nullptr, execution);
    if (scene.evolution)
        result.evolution = run_evolution(scene, *scene.evolution, data, execution);
    if (scene.work_precision)
        result.work_precision = run_work_precision(scene, *scene.work_precision, data, execution);
    return result;
}

StudyResult run_study(const Scene& scene, const Execution& execution) {
    return run_study(
        scene, scene.poses_problem() ? problem_of(scene, scene.longest_time()) : ProblemData{},
        execution);
}

} // namespace tvbeam
