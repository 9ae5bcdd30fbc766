#pragma once

#include "studies/evolution/evolution.hpp"
#include "studies/ladder/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/reference/reference_solution.hpp"
#include "studies/scene/scene.hpp"
#include "studies/stress/stress.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// The runs of one study that share their norms.
struct MeasuredRuns {
    std::string study; ///< e.g. "ladder", "work_precision.bdf2, direct"
    const std::vector<RungResult>* runs;
    const std::vector<Norm>* norms;
};

/// Everything that running a scene gave: one record for each study whose block the scene has.
struct StudyResult {
    Scene scene;
    std::vector<std::string> left_out;        ///< parts that the scene does not need, in words
    std::vector<std::string> remarks;         ///< on all studies, in sentences
    double law_distance = 0.0;                ///< ExactSolution::law_distance
    std::optional<ReferenceResult> reference; ///< if errors are measured against one
    std::optional<OrdersResult> orders;
    std::optional<LadderResult> ladder;
    std::optional<WorkPrecisionResult> work_precision;
    std::optional<EvolutionResult> evolution;
    std::optional<StressResult> stress;

    /// The runs of every study whose errors were measured.
    [[nodiscard]] std::vector<MeasuredRuns> runs() const;

    [[nodiscard]] bool failed() const;      ///< some run failed, or was interrupted
    [[nodiscard]] bool interrupted() const; ///< some run was
};

/// Runs the studies of a scene, their runs in up to `execution.jobs` threads; those that are
/// timed, of [work_precision], one at a time and after all others. Throws InputError when its
/// problem is not admissible; nothing has run then.
StudyResult run_study(const Scene& scene, const Execution& execution = {});

/// The same for a problem of the caller's, as autodiff_problem (mms/autodiff_problem.hpp) makes it,
/// in place of the scene's own. The scene is read without one (Reading::own_problem), or put
/// together in code; throws InputError where it then cannot be run (require_runnable).
StudyResult run_study(const Scene& scene, ProblemData data, const Execution& execution = {});

} // namespace tvbeam
