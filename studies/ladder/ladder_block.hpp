#pragma once

#include "studies/scene/next_level.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/scene/until.hpp"

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
    double final_time = 0.0; ///< 0: none
    std::vector<Rung> rungs;
    std::vector<Measure> norms; ///< and values
    std::optional<PublishedFigures> printed = {};
    std::optional<Until> until = {};
    NextLevel next = {}; ///< only with `until`
    /// Orders along the ladder are wanted with their intervals: nothing is known of them
    /// beforehand, or `until` asks for it.
    bool says_orders = false;
};

/// Reads the block:
///
///     final_time, elements, dt, norms     as study_keys.hpp says; norms may be absent
///     values                              of solvers that compute any
///     until                               order, limit, seconds, levels (Until)
///     [ladder.printed]
///     source                              default "published"
///     NORM                                one value a level
///
/// Throws InputError where a value is missing or breaks its rule.
LadderBlock read_ladder(TableReader& table, const SolverKeys& keys);

} // namespace tvbeam
