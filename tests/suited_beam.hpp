#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"

#include <string>

namespace tvbeam {

/// Whether some formula of a solution's temperature or deflection has this text in it.
inline bool names(const Solution& solution, const std::string& text) {
    for (const SolutionPhase& phase : solution.phases)
        for (const SourceText* source : {&phase.theta, &phase.u})
            if (source->text().find(text) != std::string::npos)
                return true;
    return false;
}

/// The ε of the stops that a shipped solution is made for; 0: rigid ones.
inline double epsilon_for(const std::string& solution) {
    return solution.starts_with("penalised") ? 0.05 : 0.0;
}

/// The beam with what a solution needs to be admissible on it: no end temperature where theta does
/// not name one, a viscosity where it divides by zeta, and stops that yield where it goes into
/// them.
inline Beam suited(Beam beam, const Solution& solution) {
    if (!names(solution, "theta_A"))
        beam.theta_A = 0.0;
    if (beam.zeta == 0.0 && names(solution, "/zeta"))
        beam.zeta = 0.1;
    beam.stops.epsilon = epsilon_for(solution.name);
    return beam;
}

} // namespace tvbeam
