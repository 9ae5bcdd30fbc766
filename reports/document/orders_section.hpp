#pragma once

#include "reports/document/document.hpp"
#include "studies/grid/grid.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

/// A table of fits of the two-term model that hold, a row each: p, q with what to quote behind ±,
/// a, b, ρ, rms and how many of the records were used. "not seen" is the order of a term whose size
/// is zero, "not determined" one that the records do not determine; a, b, ρ are blank with it.
Table fit_table(const std::vector<std::pair<std::string, const TwoTermFit*>>& fits,
                std::size_t records);

/// The whole of an [orders] study: the fits, what they leave out, the constants of Corollary 2.2.
Section orders_section(const OrdersResult& orders, const OrdersBlock& block);

} // namespace tvbeam
