#pragma once

#include "core/problem.hpp"

#include <optional>
#include <utility>

namespace tvbeam {

/// Contact of the tip with rigid stops (6)–(8), for a step whose tip answers linearly to the
/// contact stress: u(1) = free_tip + λ·compliance with compliance > 0.
///
/// Returns the λ of the variational inequality (25): 0 when the free tip is admissible; otherwise
/// the one that puts the tip on the stop it passed, λ > 0 at g1 and λ < 0 at g2. No iteration: in
/// one unknown the projection is the exact solution. A penalised stop is passed by −ελ, so that ε
/// adds to the compliance of the beam. NaN in, NaN out.
double contact_stress(const Stops& stops, double free_tip, double compliance);

/// Which stop the tip presses on, from one solve to the next.
class PressedStop {
public:
    /// Whether it is another one, or none, or none any more; never of the first solve.
    bool changes(double stress) {
        const int now = stress > 0.0 ? 1 : stress < 0.0 ? -1 : 0;
        return std::exchange(before_, now).value_or(now) != now;
    }

private:
    std::optional<int> before_; // the sign of the stress
};

} // namespace tvbeam
