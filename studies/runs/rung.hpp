#pragma once

#include "core/run.hpp"
#include "studies/orders/observed_order.hpp"
#include "studies/runs/execution.hpp"
#include "studies/scene/scene.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tvbeam {

/// What one run of a study gave.
struct RungResult {
    Rung rung;
    RunStatus status = RunStatus::ok;
    std::string reason;   ///< why it failed; empty when ok
    double seconds = 0.0; ///< wall clock, error norms included
    Counters counters;
    std::vector<double> errors;             ///< one a norm; empty when failed
    std::vector<double> uncertainties = {}; ///< RunResult::uncertainties
};

/// Runs a scheme on one rung of the scene's beam and meshes.
RungResult run_rung(const Scene& scene, const Scheme& scheme, const std::vector<Norm>& norms,
                    double final_time, const Rung& rung, const ProblemData& data,
                    const Execution& execution = {});

/// The result of run `index` of a study that was kept; or else what `run` gives, which is kept
/// unless it was interrupted. work: of the run.
RungResult run_or_find(const std::string& study, std::size_t index, const Execution& execution,
                       double work, const std::function<RungResult()>& run);

/// Runs the scene's scheme on every rung of a study (MeasuredRuns::study), in up to
/// `execution.jobs` threads; the results stand in the order of the rungs and do not depend on the
/// number of jobs, but for their seconds.
std::vector<RungResult> run_rungs(const std::string& study, const Scene& scene,
                                  const std::vector<Norm>& norms, double final_time,
                                  const std::vector<Rung>& rungs, const ProblemData& data,
                                  const Execution& execution);

/// The runs as records for an order analysis of norm k; a failed run has a NaN error.
std::vector<Refinement> records_of(const std::vector<RungResult>& rungs, std::size_t k);

/// The same with the root of every error: what the two-term model wants of a squared norm.
std::vector<Refinement> root_records_of(const std::vector<RungResult>& rungs, std::size_t k,
                                        const Norm& norm);

/// Whether some run failed.
bool any_failed(const std::vector<RungResult>& rungs);

} // namespace tvbeam
