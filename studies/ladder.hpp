#pragma once

#include "core/run.hpp"
#include "studies/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// What one rung gave.
struct RungResult {
    Rung rung;
    RunStatus status = RunStatus::ok;
    std::string reason;   ///< why it failed; empty when ok
    double seconds = 0.0; ///< wall clock, error norms included
    Counters counters;
    std::vector<double> errors; ///< one a norm; empty when failed
    std::vector<std::optional<double>>
        orders; ///< observed order against the rung before; one a norm
};

/// The record of a ladder study.
struct LadderResult {
    std::vector<std::string> norms;
    std::vector<RungResult> rungs;
    std::vector<std::string> remarks; ///< what the observed orders show, a sentence or more a norm

    [[nodiscard]] bool failed() const; ///< some rung failed
};

/// Runs every rung of the scene's ladder, the others also after one that failed.
LadderResult run_ladder(const Scene& scene, const LadderBlock& ladder, const ProblemData& data);

} // namespace tvbeam
