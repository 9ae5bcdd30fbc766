#include "studies/runs/defects.hpp"

#include "studies/scene/scene.hpp"

namespace tvbeam {

Defects::Defects(const GivenData& defect, const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    const double final_time = scene.longest_time();
    for (const auto& series : scene.series())
        for (const auto& [elements, steps, dt] : series.rungs)
            if (!by_run_.contains({elements, dt}))
                by_run_[{elements, dt}] = given_defect(defect, solution, scene.beam, final_time,
                                                       1.0 / static_cast<double>(elements), dt);
}

Defects Defects::with(const Defects& others, double factor) const {
    Defects both;
    for (const auto& [run, added] : others.by_run_)
        both.by_run_[run] = sum(none() ? ProblemData{} : by_run_.at(run), added, factor);
    return both;
}

ProblemData Defects::added_to(const ProblemData& problem, const Rung& rung) const {
    return none() ? problem : sum(problem, by_run_.at({rung.elements, rung.dt}));
}

} // namespace tvbeam
