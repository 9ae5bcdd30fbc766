#pragma once

#include "core/space/linear_elements.hpp"
#include "core/time/time_scheme.hpp"

#include <string>

namespace tvbeam {

/// How one step of (24)–(25) is solved.
enum class Algorithm {
    direct,     ///< the moment form: one elimination, contact by one exact scalar step
    fixed_point ///< the paper's: Hermite nodal basis, iteration between temperature and deflection
};

/// In which unknowns the direct algorithm marches; both give the same result to round-off.
enum class Basis {
    automatic, ///< sine coefficients where mesh, data and norms allow, else nodal values
    nodal
};

/// As scenes have them: "direct", "fixed-point"; "consistent", "lumped".
std::string name_of(Algorithm algorithm);
std::string name_of(ThermalMass mass);

/// The discretisation that a run uses, besides mesh and step.
struct Scheme {
    Algorithm algorithm = Algorithm::direct;
    ThermalMass thermal_mass = ThermalMass::consistent;
    double tolerance = 1e-7; ///< fixed point only: largest change of a nodal value of θ and u in
                             ///< the last iteration
    TimeScheme time = TimeScheme::named("euler");
    Basis basis = Basis::automatic;
};

} // namespace tvbeam
