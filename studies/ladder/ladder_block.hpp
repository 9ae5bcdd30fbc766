#pragma once

#include "studies/scene/study_keys.hpp"

#include <cstdint>
#include <functional>
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

/// Until when a ladder is refined beyond the levels that it names. A bound that is absent is none;
/// seconds or levels are there.
struct Until {
    std::optional<double> order; ///< half of the 95 % interval of the order of every norm
    std::optional<double> limit; ///< the same of the limit of every value
    std::optional<double> seconds;
    std::optional<std::int64_t> levels; ///< all together
    bool adds_levels = true;            ///< false: in a short form, which has those that it names
};

/// With fewer levels nothing counts as known.
inline constexpr std::size_t least_known_levels = 4;
/// The ratio in which a width shrinks at least from level to level where levels are added.
inline constexpr double least_ratio_of_levels = 1.4142135623730951;

/// The block [ladder]: the same problem on a sequence of meshes and steps.
struct LadderBlock {
    double final_time = 0.0; ///< 0: none
    std::vector<Rung> rungs;
    std::vector<Measure> norms; ///< and values
    std::optional<PublishedFigures> printed = {};
    std::optional<Until> until = {};
    /// The level behind those that there are, by the ratio in which those that the block names
    /// refine, in the mean, or least_ratio_of_levels where that is larger; none where a run may
    /// not have it. Only with `until`.
    std::function<std::optional<Rung>(const std::vector<Rung>&)> next = {};
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
