#pragma once

#include "studies/runs/execution.hpp"
#include "studies/shards/shard.hpp"

#include <cstddef>

namespace tvbeam {

/// How a shard ended.
struct ShardEnd {
    std::size_t there = 0;   ///< runs and cases that are its own and are finished
    std::size_t failed = 0;  ///< of those, made now, that failed
    std::size_t missing = 0; ///< that were interrupted
};

/// Makes the runs and cases of a scene that are the shard's and are not there yet;
/// execution.finished, which is needed, keeps them. Nothing is analysed. Throws InputError where
/// the problem is not admissible.
ShardEnd run_shard(const Scene& scene, const Shard& shard, const Execution& execution);

} // namespace tvbeam
