#pragma once

#include "studies/study.hpp"

namespace tvbeam {

/// Refuses what would take too long, unless it is wanted, and says of what takes long how long.
/// Throws InputError.
void predict(const Scene& scene, bool quiet, bool really_long);

/// Runs the studies of a scene with a line of progress.
/// @param finished runs of an earlier attempt; may be null
StudyResult run_shown(const Scene& scene, bool quiet, int jobs, FinishedRuns* finished);

} // namespace tvbeam
