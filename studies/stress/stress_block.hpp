#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// Initial temperature, over the steady θ_A (1 − x), and curvature of a stress case, of size 1.
enum class InitialData {
    zero,
    smooth, ///< θ = −u_xx = sin πx
    rough,  ///< sawtooths of the highest frequency of the mesh
    random  ///< uniform in [−1, 1], from the case's seed
};

/// One case of a stress study: a problem, its discretisation and how long it is run.
struct StressParameters {
    double alpha = 0.0;
    double zeta = 0.0;
    double dt = 0.0;
    std::int64_t elements = 0;
    std::int64_t steps = 0;
    Stops stops;
    double theta_A = 0.0;
    double load = 0.0; ///< amplitude of heat source, shear load and end moment; 0: none of them
    InitialData initial = InitialData::zero;
    unsigned seed = 1;
    std::string time;
    ThermalMass thermal_mass = ThermalMass::consistent;
    Algorithm algorithm = Algorithm::direct;
};

/// The cases of one table [stress.sweep.NAME].
struct StressSweep {
    std::string name;
    std::vector<StressParameters> cases;
};

/// [stress.contraction]: the fixed point's contraction, predicted and measured, on a map.
struct ContractionBlock {
    std::vector<double> alpha; ///< columns
    std::vector<double> dt;    ///< rows
    double zeta = 0.0;
    std::int64_t elements = 0;
    std::string time;
    ThermalMass thermal_mass = ThermalMass::consistent;
};

/// [stress.roundoff]: the floor that round-off sets under every error, against the mesh.
struct RoundOffBlock {
    double alpha = 0.0;
    double zeta = 0.0;
    double dt = 0.0;
    std::int64_t steps = 0;
    std::string time;
    ThermalMass thermal_mass = ThermalMass::consistent;
    std::vector<std::int64_t> elements;
    std::int64_t finest_hermite = 0; ///< the Hermite form is run up to this mesh
};

/// The block [stress].
struct StressBlock {
    std::vector<StressSweep> sweeps;
    std::optional<ContractionBlock> contraction;
    std::optional<RoundOffBlock> roundoff;
};

/// Reads the block. A sweep holds lists of values for
///
///     alpha, zeta, dt, elements, gap (inf: no stops), sides ("both", "lower", "upper"), load,
///     initial ("zero", "smooth", "rough", "random"), time, thermal_mass, algorithm, theta_A
///
/// and sampling = "each" (the first value of every list is the base, from which one list at a time
/// is gone through), "product", or "sobol" with the number of `points`. `steps` is the number of
/// steps of a case and `work` bounds steps × elements; a case has two steps at least.
/// Throws InputError.
StressBlock read_stress(TableReader& table);

} // namespace tvbeam
