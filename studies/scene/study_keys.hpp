#pragma once

#include "core/norms/norms.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tvbeam {

class TableReader;

/// One run of a study: s elements, h = 1/s, and N steps of length dt. On a mesh that is not uniform
/// h is the mean length, to which those of a family of meshes are in proportion.
struct Rung {
    std::int64_t elements = 0;
    std::int64_t steps = 0;
    double dt = 0.0; ///< as the scene gives it; steps · dt = final_time to rounding
};

/// What a run may have.
inline constexpr std::int64_t most_elements = 10'000'000;
inline constexpr double most_steps = 1e12;

/// Readers of the keys that the blocks of the studies share. Each throws InputError where a value
/// is missing or breaks its rule.

/// final_time > 0
double read_final_time(TableReader& table);

/// elements: a list that is not empty, each from 1 to most_elements.
std::vector<std::int64_t> read_elements(TableReader& table);

/// The number of steps of length dt in final_time; they must fill it to 1e-9 of a step. index: of
/// dt in its list, for the place of a message.
std::int64_t steps_of(const TableReader& table, std::size_t index, double final_time, double dt);

/// The rungs of a ladder, from coarse to fine: elements, and dt as a list of one number a rung or
/// as one expression in s.
std::vector<Rung> read_rungs(TableReader& table, double final_time);

/// norms: known names, none twice; may be absent.
std::vector<Norm> read_norms(TableReader& table);

} // namespace tvbeam
