#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"

#include <string>

namespace tvbeam {

/// A solution and the beam that it is looked at on.
struct SolutionSetting {
    Solution solution;
    Beam beam;
    double final_time = 0.0;
    std::string origin; ///< where the beam comes from, e.g. "the beam of the scene table1"
};

/// What a name on the command line means: a scene and its solution; a shipped solution, with the
/// first shipped scene that runs it; a solution file, with the first scene beside it that
/// runs it, or else the paper's beam up to t = 2. Throws InputError for a scene without exact
/// solution and whatever read_scene and read_solution refuse.
SolutionSetting solution_setting(const std::string& name);

} // namespace tvbeam
