#pragma once

#include "studies/reference/reference_solution.hpp"
#include "studies/scene/scene.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A series of runs and their results.
struct MeasuredRuns {
    Series series;
    const std::vector<RungResult>* results;
};

/// What became of sources and exact fields that do not separate (core/low_rank/separated.hpp).
struct SeparationResult {
    Eigen::Index rank = 0; ///< products that stand for them; 0: none do
    double residual = 0.0; ///< over the greatest value
    std::string
        reason; ///< why they are evaluated at every point in every step; empty: they are not
};

/// How finely [0, 1] is cut for the functions of the problem to be integrated
/// (core/space/resolution.hpp).
struct QuadratureResult {
    std::size_t intervals = 1;
    double finest = 1.0; ///< the shortest of them
};

/// Everything that running a scene gave: one record for each study whose block the scene has.
struct StudyResult {
    Scene scene;
    std::vector<std::string> left_out = {};        ///< parts that the scene does not need, in words
    std::vector<std::string> remarks = {};         ///< on all studies, in sentences
    double law_distance = 0.0;                     ///< ExactSolution::law_distance
    std::optional<ReferenceResult> reference = {}; ///< if errors are measured against one
    std::optional<QuadratureResult> quadrature = {}; ///< none beside a defect, which is cut apart
    SeparationResult separation = {};
    ByKind records = {};

    /// The record of a study, e.g. get<LadderResult>(); null where there is none.
    template <typename Record>
    [[nodiscard]] const Record* get() const {
        return records.get<Record>();
    }
    template <typename Record>
    [[nodiscard]] Record* get() {
        return records.get<Record>();
    }

    /// The runs of every study whose errors were measured.
    [[nodiscard]] std::vector<MeasuredRuns> runs() const;

    /// The metrics of a study; none where the scene does not have it.
    [[nodiscard]] std::map<std::string, double> figures(const std::string& study) const;

    /// How the studies ended, all together.
    [[nodiscard]] Ending ending() const;
    [[nodiscard]] bool failed() const { return ending().failed; } ///< or was interrupted
    [[nodiscard]] bool interrupted() const { return ending().interrupted; }
};

/// What the studies of a scene cost, about, in the unit of work_of(Method, Rung).
double work_of(const Scene& scene);
double reference_work(const Scene& scene); ///< of that, what a [reference] does

/// Refuses what is there to be told before anything runs, besides what a reader told: throws
/// InputError where there is no such program as [solver] calls.
void require_runnable(const Scene& scene);

/// Runs the studies of a scene, their runs in up to `execution.jobs` threads; those that are
/// timed, of [work_precision], one at a time and after all others. Throws InputError when its
/// problem is not admissible; nothing has run then.
StudyResult run_study(const Scene& scene, const Execution& execution = {});

/// The same for a problem of the caller's, as autodiff_problem (mms/autodiff_problem.hpp) makes it,
/// in place of the scene's own. The scene is read without one (Reading::own_problem), or put
/// together in code; throws InputError where it then cannot be run (require_runnable).
StudyResult run_study(const Scene& scene, const ProblemData& data, const Execution& execution = {});

/// The same with these defects in place of the scene's own.
StudyResult run_study(const Scene& scene, const ProblemData& data, const Defects& defects,
                      const Execution& execution);

/// Prepares what the studies of a scene run on, and gives it to the caller in their place. Throws
/// InputError as run_study does.
void on_prepared(const Scene& scene, const Execution& execution,
                 const std::function<void(const StudyContext&)>& conduct);

} // namespace tvbeam
