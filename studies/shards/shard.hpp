#pragma once

#include "studies/predicted_work.hpp"
#include "studies/shards/work_group.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// A part of the work of a scene, as one of several programs does it.
struct Shard {
    std::uint32_t number = 1; ///< from 1
    std::uint32_t of = 1;

    [[nodiscard]] std::string name() const; ///< "3/100"
};

/// The shard of each run or part, by its group and its index: dealt by predicted work, the longest
/// first and each to the shard that has least, so that shards end together. The same on every
/// machine.
std::vector<std::vector<std::uint32_t>> dealt(const std::vector<WorkGroup>& groups,
                                              std::uint32_t shards);

/// What each of so many shards takes: its own runs, and a reference, which every shard makes for
/// itself.
std::vector<PredictedWork> predicted_shards(const Scene& scene, std::uint32_t shards);

/// What is left to the merge of all: a reference, an evolution, a sensitivity.
PredictedWork predicted_merge(const Scene& scene);

/// Throws InputError where a scene cannot be dealt: its runs are timed, each depends on the last,
/// or there are none.
void require_dealable(const Scene& scene);

} // namespace tvbeam
