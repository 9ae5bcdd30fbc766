#include "studies/shards/run_shard.hpp"

#include "studies/runs/parallel.hpp"
#include "studies/study.hpp"

#include <atomic>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

struct Task {
    const WorkGroup* group;
    std::size_t index;
};

/// Whether it is there afterwards.
bool make(const Task& task, const RunCall& run, const Execution& execution) {
    const auto& [group, index] = task;
    if (!group->series)
        return make_or_find(group->parts, index, execution).has_value();
    if (!execution.advance(0.0))
        return false;
    return run_or_find(*group->series, index, run, execution).status != RungStatus::interrupted;
}

} // namespace

ShardEnd run_shard(const Scene& scene, const Shard& shard, const Execution& execution) {
    const auto groups = work_groups(scene);
    const auto owners = dealt(groups, shard.of);
    std::vector<Task> tasks;
    std::vector<double> costs;
    double work = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t i = 0; i < groups[g].count(); ++i)
            if (owners[g][i] == shard.number) {
                tasks.push_back({&groups[g], i});
                costs.push_back(groups[g].work(i));
                work += groups[g].series
                            ? work_of(groups[g].series->method, groups[g].series->rungs[i])
                            : groups[g].parts.work(i);
            }
    execution.expect(work);
    std::atomic<std::size_t> there = 0;
    on_prepared(scene, execution, [&](const StudyContext& context) {
        for_each_longest_first(costs, execution.jobs, [&](std::size_t k) {
            if (make(tasks[k], context.solver.run, execution))
                ++there;
        });
    });
    return {there, tasks.size() - there};
}

} // namespace tvbeam
