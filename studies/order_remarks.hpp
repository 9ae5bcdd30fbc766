#pragma once

#include "core/norms.hpp"
#include "studies/observed_order.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tvbeam {

/// What the pairwise orders of one norm show along a ladder, in sentences: the range they keep,
/// where they leave it and what that means. Steady: within 0.15 of the first (0.3 for a square).
/// Nothing for fewer than two orders.
std::vector<std::string> order_remarks(const Norm& norm, std::span<const Refinement> ladder,
                                       std::span<const std::optional<double>> orders);

} // namespace tvbeam
