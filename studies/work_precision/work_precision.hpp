#pragma once

#include "studies/runs/execution.hpp"
#include "studies/runs/studied_solver.hpp"
#include "studies/work_precision/timing.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// One scheme along its ladder.
struct SchemeRuns {
    /// With the errors of an untimed run, and the counters of a timed one.
    std::vector<RungResult> runs;
    /// One a run; none where the run failed, or an interruption came before.
    std::vector<std::optional<Timing>> timings;
    std::string unsteady; ///< on errors that were others when they were timed; mostly empty
};

/// Two schemes at the same error.
struct SchemeComparison {
    std::size_t faster = 0; ///< by the medians; index of a scheme of the block
    std::size_t slower = 0;
    Comparison times;
};

/// What it takes to bring a norm down to an error.
struct ReachedError {
    double error = 0.0;
    bool target = false;                       ///< the scene names it
    std::vector<std::optional<Timing>> times;  ///< one a scheme; see time_to_reach
    std::vector<SchemeComparison> comparisons; ///< of every two schemes that reach it
};

/// One norm over all schemes.
struct NormCosts {
    Measure norm;
    /// From large to small: 1e-2 … 1e-9 and on to the smallest error measured, and the targets.
    std::vector<ReachedError> errors;
    std::vector<std::string> remarks; ///< errors that rise along a ladder, in sentences
};

/// The record of a [work_precision] study.
struct WorkPrecisionResult {
    std::vector<SchemeRuns> schemes; ///< in the order of the block
    std::vector<NormCosts> norms;    ///< in the order of the block
    std::string busy_remark;         ///< see busy_remark
    bool interrupted = false;        ///< runs are missing, timed ones perhaps
};

/// The runs that the block asks for, a series a scheme.
std::vector<Series> series_of(const WorkPrecisionBlock& block);

/// Whether a row was timed and can be compared: a clock of a program's own may show nothing of a
/// short run.
bool has_time(const std::optional<Timing>& timing);

/// A sentence where the runs had less than nine tenths of a core: a run that is shorter than the
/// turn that the system gives a program is then timed right, a longer one with the turns of others,
/// which no quartile shows. Empty otherwise.
std::string busy_remark(double processor_seconds, double wall_clock_seconds);

/// Elements times steps: the size of a run, whatever the algorithm makes of it; of one beyond the
/// range, which no scene has but a program may, the greatest.
std::uint64_t node_steps(const Rung& rung);

/// Runs every rung of every scheme once for its errors, and then for its time: an untimed run, and
/// block.runs timed ones, or one where a run takes longer than one_run_above seconds; fewer, 5 at
/// least, where fewer fill half a second. The runs of
/// all rungs take turns, so that a machine that is busy for a while slows all alike, and nothing
/// runs beside them, whatever execution.jobs says. Errors are kept as run_or_find does; times are
/// not. Timed runs measure nothing, unless that costs nothing: they fail where they lack an error,
/// and errors that differ from those of the first run are remarked on.
WorkPrecisionResult run_work_precision(const WorkPrecisionBlock& block, const StudiedSolver& solver,
                                       const Execution& execution = {}, double one_run_above = 2.0);

/// What the rows say, for every norm of the block.
std::vector<NormCosts> costs_of(const WorkPrecisionBlock& block,
                                const std::vector<SchemeRuns>& schemes);

} // namespace tvbeam
