#pragma once

#include "studies/scene/study_keys.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Figures to compare with, a list of one figure a rung for each norm.
struct PublishedFigures {
    std::string source; ///< where they were printed
    std::map<std::string, std::vector<double>> figures;
};

/// The block [ladder]: the same problem on a sequence of meshes and steps.
struct LadderBlock {
    double final_time = 0.0;
    std::vector<Rung> rungs;
    std::vector<Measure> norms;
    std::optional<PublishedFigures> printed;
};

/// Reads the block:
///
///     final_time, elements, dt, norms     as study_keys.hpp says; norms may be absent
///     [ladder.printed]
///     source                              default "published"
///     NORM                                one value a level
///
/// Throws InputError where a value is missing or breaks its rule.
LadderBlock read_ladder(TableReader& table, const SolverKeys& keys);

} // namespace tvbeam
