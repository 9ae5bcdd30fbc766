#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tvbeam {

/// ε s⁴: the round-off of one solve with the Hermite form's B, whose condition is s⁴, at most.
inline double hermite_solve_round_off(std::int64_t elements) {
    const auto s = static_cast<double>(elements);
    return std::numeric_limits<double>::epsilon() * s * s * s * s;
}

/// The floor that round-off sets under the curvature of the Hermite form, relative to the
/// curvature:
///
///     0.01 ε s⁴ n,     n = min(steps, 1 + ζ/Δt)
///
/// The rounding of B's factors is the same in every step, so that the
/// error adds up over the n steps that viscosity remembers. The constant was measured, on the
/// coupled mode sin πx by Euler steps: it holds within a factor of 5 for s = 10 … 10⁴ (scene
/// `roundoff`), of 7 for 2000 steps. SDIRK2, which solves twice a step, has up to four times that.
inline double hermite_floor(std::int64_t elements, double zeta, double dt, std::int64_t steps) {
    const double remembered = std::min(static_cast<double>(steps), 1.0 + zeta / dt);
    return 0.01 * hermite_solve_round_off(elements) * remembered;
}

} // namespace tvbeam
