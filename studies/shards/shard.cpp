#include "studies/shards/shard.hpp"

#include "mms/text/input_error.hpp"
#include "studies/study.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace tvbeam {

namespace {

struct Unit {
    double work = 0.0;
    std::uint64_t draw = 0;
    std::size_t group = 0;
    std::size_t index = 0;
};

/// Mixes the bits of a number (Steele, Lea and Flood 2014, SplitMix64). Cases that take as long as
/// each other stand in the order of their lists; dealt in turn, a shard would get the same values
/// of a list every time, and with them all the refusals, or all the contact.
std::uint64_t mixed(std::uint64_t number) {
    number += 0x9e3779b97f4a7c15U;
    number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
    return number ^ (number >> 31U);
}

} // namespace

std::string Shard::name() const {
    return std::to_string(number) + "/" + std::to_string(of);
}

std::vector<std::vector<std::uint32_t>> dealt(const std::vector<WorkGroup>& groups,
                                              std::uint32_t shards) {
    std::vector<Unit> units;
    std::vector<std::vector<std::uint32_t>> owners;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        owners.emplace_back(groups[g].count(), 0);
        for (std::size_t i = 0; i < groups[g].count(); ++i)
            units.push_back({groups[g].work(i), mixed(units.size()), g, i});
    }
    std::sort(units.begin(), units.end(), [](const Unit& a, const Unit& b) {
        return std::pair(-a.work, a.draw) < std::pair(-b.work, b.draw);
    });
    using Load = std::pair<double, std::uint32_t>;
    std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
    for (std::uint32_t shard = 1; shard <= shards; ++shard)
        loads.emplace(0.0, shard);
    for (const Unit& unit : units) {
        const auto [load, shard] = loads.top();
        loads.pop();
        owners[unit.group][unit.index] = shard;
        loads.emplace(load + unit.work, shard);
    }
    return owners;
}

std::vector<PredictedWork> predicted_shards(const Scene& scene, std::uint32_t shards) {
    PredictedWork empty = predicted_work(scene);
    empty.runs = 0.0;
    empty.steps = scene.solver ? 0.0 : reference_work(scene);
    empty.at_most = 0.0;
    std::vector<PredictedWork> predicted(shards, empty);
    const auto groups = work_groups(scene);
    const auto owners = dealt(groups, shards);
    for (std::size_t group = 0; group < groups.size(); ++group)
        for (std::size_t i = 0; i < owners[group].size(); ++i) {
            PredictedWork& one = predicted[owners[group][i] - 1];
            ++one.runs;
            if (!scene.solver) // what a program takes is known to nobody here
                one.steps += groups[group].work(i);
        }
    for (PredictedWork& one : predicted) {
        one.seconds = one.steps / steps_a_second + one.runs * seconds_a_run;
        if (scene.solver && scene.solver->timeout) {
            one.at_most = one.runs * *scene.solver->timeout;
            one.bounded_by = "by the time-out of each run";
        }
    }
    return predicted;
}

PredictedWork predicted_merge(const Scene& scene) {
    PredictedWork predicted = predicted_work(scene);
    for (const auto& group : work_groups(scene))
        for (std::size_t i = 0; i < group.count(); ++i) {
            predicted.steps -= group.work(i);
            predicted.runs -= 1.0;
        }
    predicted.steps = std::max(predicted.steps, 0.0);
    predicted.runs = std::max(predicted.runs, 0.0);
    predicted.seconds = predicted.steps / steps_a_second + predicted.runs * seconds_a_run;
    predicted.at_most = 0.0;
    return predicted;
}

void require_dealable(const Scene& scene) {
    const Place place{scene.file};
    if (scene.get<WorkPrecisionBlock>() != nullptr)
        throw InputError(place, "times its runs in [work_precision], which others beside them "
                                "would disturb; run it as a whole, without --shard");
    for (const auto& [kind, block] : scene.blocks.entries())
        if (kind->until(block) != nullptr)
            throw InputError(place, "adds runs to its [" + kind->name() +
                                        "] (until), each chosen after the last; run it as a "
                                        "whole, without --shard");
    const auto groups = work_groups(scene);
    if (std::all_of(groups.begin(), groups.end(),
                    [](const WorkGroup& group) { return group.count() == 0; }))
        throw InputError(place, "has no runs that could be made apart from each other; run it as "
                                "a whole, without --shard");
}

} // namespace tvbeam
