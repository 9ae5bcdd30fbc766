#pragma once

#include "core/probe.hpp"
#include "studies/scene/study_keys.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

class TableReader;

/// A probe with the name that the scene gives it.
struct NamedProbe {
    std::string name; ///< e.g. "u@1"
    Probe probe;
};

/// The block [evolution]: one run, looked at in time.
struct EvolutionBlock {
    double final_time = 0.0;
    Rung rung;
    std::vector<NamedProbe> probes;     ///< at least one
    std::int64_t every = 1;             ///< steps from one sample to the next
    std::optional<std::int64_t> period; ///< steps in a period; a multiple of `every`

    [[nodiscard]] std::vector<Probe> quantities() const; ///< the probes without their names
};

/// Reads the block:
///
///     final_time, elements, dt    one number each
///     probes                      "theta@X", "u@X" with X in [0, 1]; "stress", "energy"
///     every                       a sample is kept every so many steps; default 1
///     period                      of the load: what changes from one period to the next is shown
///
/// Throws InputError where a value is missing or breaks its rule.
EvolutionBlock read_evolution(TableReader& table);

} // namespace tvbeam
