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

bool is_there(const Task& task, FinishedRuns& finished) {
    const auto& [group, index] = task;
    return group->series ? finished.find(*group->series, index).has_value()
                         : finished.find_part(group->study, index).has_value();
}

RungStatus make(const Task& task, const RunCall& run, const Execution& execution) {
    const auto& [group, index] = task;
    if (!group->series) {
        const Parts& parts = group->parts;
        const std::any result = make_or_find(parts, index, execution);
        if (!result.has_value())
            return RungStatus::interrupted;
        return parts.has_failed && parts.has_failed(result) ? RungStatus::failed : RungStatus::ok;
    }
    if (!execution.advance(0.0))
        return RungStatus::interrupted;
    return run_or_find(*group->series, index, run, execution).status;
}

} // namespace

ShardEnd run_shard(const Scene& scene, const Shard& shard, const Execution& execution) {
    const auto groups = work_groups(scene);
    const auto owners = dealt(groups, shard.of);
    std::vector<Task> tasks;
    std::vector<double> costs;
    double work = 0.0;
    ShardEnd end;
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t i = 0; i < groups[g].count(); ++i) {
            const Task task{&groups[g], i};
            if (owners[g][i] != shard.number)
                continue;
            if (is_there(task, *execution.finished)) {
                ++end.there;
                continue;
            }
            tasks.push_back(task);
            costs.push_back(groups[g].work(i));
            work += groups[g].series ? work_of(groups[g].series->method, groups[g].series->rungs[i])
                                     : groups[g].parts.work(i);
        }
    if (tasks.empty()) // what runs are prepared with, a reference say, takes long
        return end;
    execution.expect(work);
    std::atomic<std::size_t> made = 0;
    std::atomic<std::size_t> failed = 0;
    on_prepared(scene, execution, [&](const StudyContext& context) {
        for_each_longest_first(costs, execution.jobs, [&](std::size_t k) {
            const RungStatus status = make(tasks[k], context.solver.run, execution);
            made += status == RungStatus::interrupted ? 0 : 1;
            failed += status == RungStatus::failed ? 1 : 0;
        });
    });
    end.there += made;
    end.failed = failed;
    end.missing = tasks.size() - made;
    return end;
}

} // namespace tvbeam
