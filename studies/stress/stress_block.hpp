#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// One list of values of a sweep: sets the one at an index in a case.
struct StressAxis {
    std::size_t values = 1;
    std::function<void(StressParameters&, std::size_t)> set;
};

/// What of the product of the lists becomes a case.
enum class Sampling {
    each,    ///< the first values of all, and then one list at a time gone through
    product, ///< all
    sobol    ///< Sobol (1967): so many points that fill it evenly
};

/// The cases of one table [stress.sweep.NAME], each put together when it is asked for.
class StressSweep {
public:
    /// points: of Sobol's sequence. steps: of a case, at most, which work bounds as read_stress
    /// says.
    StressSweep(std::string name, std::vector<StressAxis> axes, Sampling sampling,
                std::size_t points, std::int64_t steps, std::int64_t work);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] StressParameters at(std::size_t index) const;

private:
    [[nodiscard]] std::vector<std::size_t> values_of(std::size_t index) const;

    std::string name_;
    std::vector<StressAxis> axes_;
    Sampling sampling_;
    std::int64_t steps_;
    std::int64_t work_;
    std::size_t size_ = 0;
    std::vector<std::uint16_t> sobol_; ///< an index a list, case after case
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

    /// Of all sweeps in turn.
    [[nodiscard]] std::size_t cases() const;
    [[nodiscard]] StressParameters case_at(std::size_t index) const;
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
