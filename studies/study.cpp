#include "studies/study.hpp"

#include <algorithm>

namespace tvbeam {

bool StudyResult::failed() const {
    return (orders && any_failed(orders->runs)) || (ladder && any_failed(ladder->rungs));
}

StudyResult run_study(const Scene& scene, int jobs) {
    StudyResult result{.scene = scene, .left_out = {}, .reference = {}, .orders = {}, .ladder = {}};
    // One problem serves all studies: it is admissible up to the longest of their times.
    const double final_time = std::max(scene.ladder ? scene.ladder->final_time : 0.0,
                                       scene.orders ? scene.orders->final_time : 0.0);
    ProblemData data = problem_of(scene, final_time);
    if (scene.reference && (scene.orders || !scene.ladder->norms.empty()))
        result.reference = measure_against_reference(scene, final_time, data);
    result.left_out = left_out(scene, data);
    if (scene.orders)
        result.orders = run_orders(scene, *scene.orders, data, jobs);
    if (scene.ladder)
        result.ladder =
            run_ladder(scene, *scene.ladder, data, result.orders ? &*result.orders : nullptr, jobs);
    return result;
}

} // namespace tvbeam
