/// The sizes of two error terms whose orders are known.
#pragma once

#include "studies/orders/observed_order.hpp"

#include <optional>
#include <span>
#include <string>

namespace tvbeam {

/// A size with the half-width of its 95 % interval.
struct FittedSize {
    double value = 0.0;
    double uncertainty = 0.0;
};

struct KnownOrderSizes {
    std::string failure;         ///< why nothing is fitted; empty: it is
    std::optional<FittedSize> a; ///< of h^p; none: no such term, or not seen
    std::optional<FittedSize> b; ///< of Δt^q; likewise
};

/// Linear least squares, relative to e², of
///
///     e² = a² h^2p (1 + … h²) + 2ρab h^p Δt^q (1 + … h² + … Δt) + b² Δt^2q (1 + … Δt)
///
/// for norms e; the three corrections of the next order take up what the coarse rows have more than
/// their leading terms. What they leave is no scatter: the half-width of a size is no less than
/// what the size differs by, beyond its own half-width, without the coarsest level of its width,
/// where these rows are enough.
/// p or q none: no such term. Records that are not finite are passed over; it takes two more than
/// there are columns.
///
/// Where e is a maximum over time ρ is not the same in all rows: one term is largest at one time,
/// the other at another, and which of them counts changes with their ratio r. The size of a term is
/// then known as far as the rows in which it is the larger one agree, if there are any: its
/// half-width is greater by the distance of the fit with weights 1/(1 + r⁸), r the other term over
/// it, and by r²/2 of itself in the row that shows it best, as e = A + ρB + (1 − ρ²)B²/2A + ….
KnownOrderSizes fit_known_orders(std::span<const Refinement> records, std::optional<double> p,
                                 std::optional<double> q, bool is_maximum = false);

} // namespace tvbeam
