#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/solver.hpp"
#include "core/space/mesh.hpp"
#include "core/space/resolution.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tvbeam {

/// How a run ended.
enum class RunStatus {
    ok,
    failed,     ///< diverged, overflowed, or could not start; RunResult::reason says why and where
    interrupted ///< RunRequest::advance said so
};

/// One march of one scheme over one mesh, from 0 to final_time in `steps` equal steps.
struct RunRequest {
    Beam beam;
    Mesh mesh;
    Scheme scheme;
    double final_time = 0.0;
    std::int64_t steps = 0;
    std::vector<Norm> norms; ///< need data.exact
    /// Told at the start, and then every few steps, how many more have been made; false: the run
    /// ends. Empty: nobody asks.
    std::function<bool(std::int64_t steps)> advance = {};
};

struct RunResult {
    RunStatus status = RunStatus::ok;
    std::string reason = {};         ///< empty when ok
    std::vector<double> errors = {}; ///< in the order of RunRequest::norms; empty when failed
    /// The part of each error that quadrature leaves uncertain (quadrature_uncertainties); empty:
    /// none of any.
    std::vector<double> uncertainties = {};
    Counters counters = {};
};

/// The solver for a scheme, at t = 0; data and mesh must outlive it. Throws std::domain_error when
/// it cannot start, and where the contraction that is predicted for the fixed point is 1 or more.
std::unique_ptr<Solver> make_solver(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                                    const Scheme& scheme, double dt, const Needs& needs);
std::unique_ptr<Solver> make_solver(const Beam& beam, const ProblemData& data, Mesh&& mesh,
                                    const Scheme& scheme, double dt, const Needs& needs) = delete;

/// How finely the functions of a problem must be cut for runs by these algorithms with these norms:
/// what such a run finds out by itself where ProblemData::resolution is not there.
Resolution resolution_of(const ProblemData& data, const std::vector<Algorithm>& algorithms,
                         const std::vector<Norm>& norms, double final_time);

/// Somebody who looks at every state of a run.
struct Observer {
    Needs needs;                                               ///< what is looked at
    std::function<void(double t, const Solver& solver)> visit; ///< at t = 0, and after each step
};

/// Runs to the end or to the first step that fails. Does not throw for a failing run, nor for a
/// request without a meaning, as a negative zeta, which fails with that reason. An observed
/// run marches in nodal values.
RunResult run(const RunRequest& request, const ProblemData& data,
              const Observer* observer = nullptr);

} // namespace tvbeam
