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
/// their leading terms. p or q none: no such term. Records that are not finite are passed over; it
/// takes two more than there are columns.
KnownOrderSizes fit_known_orders(std::span<const Refinement> records, std::optional<double> p,
                                 std::optional<double> q);

} // namespace tvbeam
