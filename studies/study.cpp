#include "studies/study.hpp"

namespace tvbeam {

StudyResult run_study(const Scene& scene) {
    StudyResult result{.scene = scene, .left_out = {}, .ladder = {}};
    if (scene.ladder) {
        const ProblemData data = problem_of(scene, scene.ladder->final_time);
        result.left_out = left_out(scene, data);
        result.ladder = run_ladder(scene, *scene.ladder, data);
    }
    return result;
}

} // namespace tvbeam
