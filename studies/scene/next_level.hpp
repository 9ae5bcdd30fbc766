#pragma once

#include "mms/text/source_text.hpp"
#include "studies/runs/run.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace tvbeam {

/// The ratio in which a width shrinks at least from level to level where levels are added.
inline constexpr double least_ratio_of_levels = 1.4142135623730951;

/// The level behind those that there are; none where a run may not have it.
using NextLevel = std::function<std::optional<Rung>(const std::vector<Rung>& levels)>;

/// By the ratio in which the named levels refine, in the mean, or least_ratio_of_levels where that
/// is larger; h and dt by the same power of theirs. named: from coarse to fine, the last differs
/// from the first. formula: dt as an expression in s, if it is one.
NextLevel next_level(const std::vector<Rung>& named, double final_time,
                     std::optional<SourceText> formula = std::nullopt);

} // namespace tvbeam
