#pragma once

#include "reports/files/report_directory.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/study.hpp"

namespace tvbeam {

/// Refuses what would take too long, unless it is wanted, and says of what takes long how long.
/// Throws InputError.
void predict(const Scene& scene, bool quiet, bool really_long);

/// Runs the studies of a scene with a line of progress.
/// @param finished runs of an earlier attempt; may be null
StudyResult run_shown(const Scene& scene, bool quiet, int jobs, FinishedRuns* finished);

/// Writes to the directory of --out, and says what is left out. False: it is left out because the
/// end was asked for, and the same command would make it.
[[nodiscard]] bool write_reports(ReportDirectory& out, const Reported& result);

} // namespace tvbeam
