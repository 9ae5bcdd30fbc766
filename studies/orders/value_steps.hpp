/// What the steps from value to value show of a sequence, before anything is fitted to it.
#pragma once

#include "studies/orders/value_levels.hpp"

#include <cstddef>

namespace tvbeam {

/// A value is known to so many of its roundings, and no better.
inline constexpr double roundings = 8;

/// Do the last three steps, or the two that there are, go to and fro?
bool alternates(const ValueLevels& levels);

/// Whether the ratios of the steps rise and fall, as those of values that scatter do; of a smooth
/// sequence they go one way. Two show nothing.
bool is_erratic(const ValueLevels& levels);

/// Is the finest step more than what the known deviations make of no step at all?
bool is_significant(const ValueLevels& levels);

/// Whether all steps together are more than rounding to the digits printed makes, if none of them
/// is. Of scatter that is more than rounding each step must be.
bool goes_further_than_digits(const ValueLevels& levels);

/// Do the values go one way in steps that grow up to the finest, while h falls further than steps
/// of a sum of two powers can grow? Those of C h^p + D h^q with opposite signs do from their zero
/// to their greatest, while h falls by (q/p)^(1/(q − p)): 2 of h − h², 4 of √h − h; and by one
/// ratio of levels more, as the greatest may lie between two.
bool runs_apart_in_the_end(const ValueLevels& levels);

/// Do the values go one way, or to and fro throughout, and the steps between levels, each over the
/// logarithm of its ratio, grow towards the finest, which is the greatest of all? Those of h^p
/// shrink for every p > 0, so that no limit is in sight.
bool steps_grow(const ValueLevels& levels);

/// How many of the finest values are one, to the digits that they have, though the steps before
/// show no such order: a solver that is exact from there on, or one that refines no more, or a
/// maximum over nodes that stays at one of them. After one step every order that a method has may
/// have led there; of two steps the order goes on; and from three on it may grow as that of what
/// converges exponentially, like exp(−c/h). 0 where the values move, or may have converged.
std::size_t standing_still(const ValueLevels& levels, double rounding);

} // namespace tvbeam
