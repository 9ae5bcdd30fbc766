#pragma once

#include "core/problem.hpp"
#include "studies/runs/run.hpp"
#include "studies/runs/studied_solver.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

struct Scene;

/// A sentence where the most that is predicted of the Hermite form's round-off (core/round_off.hpp)
/// exceeds half of an error of u; empty where it does not, of other norms, where no exact solution
/// says how large u is, and for the direct algorithm. k: the norm's place among the measures of the
/// series.
std::string round_off_remark(const Beam& beam, const ProblemData& data, const Series& series,
                             const std::vector<RungResult>& rungs, std::size_t k);

/// Where every error is below 16 ε of the norm of the exact solution, or of what that
/// comes from (α u_xx beside θ; α θ, the moment load and σ beside u; these and u_xx beside σ; the
/// sources where all of that is zero) and not all are 0: that they are rounding, where theory has
/// no error of that norm (mms/expected_orders.hpp); else that they may be, where they do not fall
/// from one to the next of `refined`, the runs that refine every width. None otherwise, and where
/// no exact solution is known. A reference in its place adds its own rounding.
std::optional<RoundingErrors> rounding_errors(const Scene& scene, const ProblemData& data,
                                              const Series& series,
                                              const std::vector<RungResult>& runs,
                                              const std::vector<RungResult>& refined,
                                              std::size_t k);

} // namespace tvbeam
