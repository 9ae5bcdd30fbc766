#pragma once

#include "reports/document/document.hpp"
#include "studies/ladder/ladder.hpp"

namespace tvbeam {

/// The whole of a [ladder] study: a row a rung with errors, printed figures, observed orders and
/// seconds; what failed; what the orders mean.
Section ladder_section(const LadderResult& ladder, const LadderBlock& block, const Method& method);

} // namespace tvbeam
