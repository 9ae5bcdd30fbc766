#include "studies/shards/work_group.hpp"

#include "studies/predicted_work.hpp"

#include <utility>

namespace tvbeam {

double WorkGroup::work(std::size_t index) const {
    const double every_run = steps_a_second * seconds_a_run;
    return every_run + (series ? work_of(series->method, series->rungs[index]) : parts.work(index));
}

std::vector<WorkGroup> work_groups(const Scene& scene) {
    std::vector<WorkGroup> groups;
    const Method own = scene.method();
    for (const auto& [kind, block] : scene.blocks.entries())
        if (kind->measures())
            for (auto& series : kind->series(block, own)) {
                for (const Rung& added : kind->addable(block))
                    series.rungs.push_back(added);
                std::string study = series.study;
                groups.push_back({std::move(study), std::move(series), {}});
            }
    for (const auto& [kind, block] : scene.blocks.entries())
        for (auto& parts : kind->parts(block)) {
            std::string study = parts.study;
            groups.push_back({std::move(study), std::nullopt, std::move(parts)});
        }
    return groups;
}

} // namespace tvbeam
