#pragma once

#include "studies/orders/observed_order.hpp"
#include "studies/orders/order_engine.hpp"

#include <span>

namespace tvbeam {

/// The order along a ladder of refinements, with its interval.
struct LadderOrder {
    OrderInterval order; ///< in h, or in Δt where h stays
    /// h and Δt are refined in turns, not both from row to row or one of them alone: no ladder, and
    /// no order.
    bool in_turns = false;
    bool is_in_dt = false;      ///< its order is one in Δt
    bool has_logarithm = false; ///< its order stands with a factor ln
};

/// ladder: from coarse to fine by h, then by Δt. Records that are not resolved are passed over.
/// sigma: standard deviations of the errors, one a record; empty where they are not known.
/// rounded: they are what rounding to the digits printed makes.
LadderOrder order_along(std::span<const Refinement> ladder, std::span<const double> sigma = {},
                        bool rounded = false);

} // namespace tvbeam
