#pragma once

#include "core/problem.hpp"
#include "core/space/thermal_mass.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// Amplitudes of the coupled mode: θ = T sin πx, u_xx = A sin πx.
struct Mode {
    long double theta = 0.0L;
    long double w = 0.0L;
};

/// Without load and stops, T' = −π²T + αA' and A + ζA' + αT = 0. At t = 0, dt, …, steps·dt, by the
/// eigenvalues of the symmetric 2 × 2 matrix of (T, A)'. Where ζ = 0, A = −αT for t > 0: A jumps
/// there at once from what it is at t = 0, and T with it, by which T − αA keeps its value.
std::vector<Mode> exact_mode(const Beam& beam, Mode initial, double dt, std::int64_t steps);

/// What the scheme makes of it on a uniform mesh, Θ_i = T sin πx_i, by the recurrence in long
/// double of the scheme as it is stated (stated_step): sin πx_i is an eigenvector of M, K and M_c.
/// projected: u_xx(x, 0) is the L² projection of the sine and not its interpolation; the mode then
/// is the part that acts on the heat equation.
std::vector<Mode> discrete_mode(const Beam& beam, ThermalMass mass, const std::string& scheme,
                                std::int64_t elements, Mode initial, bool projected, double dt,
                                std::int64_t steps);

} // namespace tvbeam
