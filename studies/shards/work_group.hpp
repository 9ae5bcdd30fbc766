#pragma once

#include "studies/scene/scene.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Work of one study whose runs, or parts, are made apart from each other: what shards are dealt,
/// and what is kept of a run that is cut short.
struct WorkGroup {
    std::string study;            ///< by which results are kept
    std::optional<Series> series; ///< of runs; none: parts
    Parts parts;

    [[nodiscard]] std::size_t count() const { return series ? series->rungs.size() : parts.count; }

    /// Of one of them, predicted: work_of, and what any run takes besides (PredictedWork).
    [[nodiscard]] double work(std::size_t index) const;
};

/// Those of a scene, which must outlive them. With the runs that `until` may add.
std::vector<WorkGroup> work_groups(const Scene& scene);

} // namespace tvbeam
