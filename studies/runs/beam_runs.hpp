#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "studies/runs/defects.hpp"
#include "studies/runs/studied_solver.hpp"

#include <optional>
#include <vector>

namespace tvbeam {

struct RunResult;
struct Scene;

/// A scheme of the beam as a method, and back. Throws std::bad_any_cast for a method of another
/// solver.
Method method_of(const Scheme& scheme);
const Scheme& scheme_of(const Method& method);

/// Norms as measures, and back. Throws std::out_of_range for a measure that is no norm.
Measure measure_of(const Norm& norm);
std::vector<Norm> norms_of(const std::vector<Measure>& measures);

/// A run of the beam as a study has it.
RungResult rung_result(const Rung& rung, const RunResult& run, double seconds);

/// u(1, 0) of the data, the integral of (1 - x) u_xx(x, 0): without the round-off of a state of the
/// Hermite form, which solves for it. nullopt: the data are not resolved.
std::optional<double> initial_tip(const ProblemData& data);

/// The beam of a scene as a solver under study: core/run.hpp on the scene's meshes. data: the
/// scene's problem; measured: the same with what errors are measured against for its exact
/// solution; defects: added in each run. All four must outlive the result.
StudiedSolver beam_runs(const Scene& scene, const ProblemData& data, const ProblemData& measured,
                        const Defects& defects);

} // namespace tvbeam
