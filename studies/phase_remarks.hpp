#pragma once

#include "core/problem.hpp"
#include "studies/scene/scene.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What the ends of phases (ProblemData::phase_ends), and times within one at which rates jump or
/// have an infinite slope (rough_times), cost the orders in dt of a scene's runs, in a
/// paragraph for each that costs something.
///
/// At an end the equations see a jump of
///
///     [f] = [θ̃_t − α u_xxt],     [σ̃(1,t) (1 − y) − μ] = [ζ u_xxt].
///
/// A step of Δt with the end inside it, at a part r of it, takes one side of the jump for both: its
/// error is of the order rΔt times the jump, and stays in what follows. That is the order 1 for
/// every scheme, with a factor that changes with r from run to run. What of it the stress has
/// depends on what the tip does at the stops: its order is that which theory has for the whole
/// solution (expected_orders.hpp), and so is one below 1. A scheme that reads the steps before it
/// makes an error like it when the end is a level, too. With α = 0 each equation keeps its own.
///
/// data: with the exact solution of the scene; one without has no phases.
std::vector<std::string> phase_remarks(const Scene& scene, const ProblemData& data);

} // namespace tvbeam
