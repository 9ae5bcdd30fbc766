#pragma once

#include "mms/expression/enclosure.hpp"

#include <cstdint>
#include <functional>

namespace tvbeam {

/// A function of time by what encloses it between two times, which may be the same.
using EnclosedFunction = std::function<Enclosure(double begin, double end)>;

/// What is known of the greatest value of a function.
struct GreatestValue {
    double value; ///< the greatest seen; not above what was asked for: none seen above that
    double t;     ///< where
    bool proven;  ///< it is nowhere greater, up to the tolerance
};

/// The greatest value of a function on [begin, end], if it is above `limit`, by branch and bound:
/// between two times a and b at which it is f(a) and f(b), with its slopes from L to U,
///
///     f ≤ min(f(a) + U⁺ (b − a), f(b) + L⁻ (b − a), the enclosure of its values),
///
/// and the part whose bound is greatest is halved next, until no bound is above the limit, or above
/// what was seen by more than the tolerance, or 1e-12 of it. A peak of any width is found. Not
/// proven: `most_parts` were not enough, or doubles have no time between two neighbours.
GreatestValue greatest_value(const EnclosedFunction& function, double begin, double end,
                             double limit, double tolerance, std::int64_t most_parts);

} // namespace tvbeam
