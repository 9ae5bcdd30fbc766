/// The levels that a limit is sought of: values at widths, coarse to fine.
#pragma once

#include "studies/orders/limit_model.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

using ValueLevels = std::vector<ValueRow>;

/// Coarse to fine, finite, one row a width; of very many widths, one row a cell of ln h. Where no
/// σ is stated, it is that of values of equal widths, with Student's factor for their number.
ValueLevels value_levels(std::span<const ValueRow> given);

/// Three widths, each 5 % or more from the next: of 60 limits from four levels 1 % apart the
/// intervals of 6 missed, of 58 3 % apart those of 3. And 12 % in all.
bool has_three_widths(const ValueLevels& levels);

/// The finest step in units of the last digit printed; none where it is `exact` of them or more.
std::optional<double> coarsely_printed_step(const ValueLevels& levels, double exact);

/// Rounding is a scatter that values of equal widths, which are rounded alike, may not show.
void add_rounding(ValueLevels& levels);

/// How far from printed values that are all the same their limit may be: rounding is half a unit,
/// and what hides in a unit goes on at first order at worst.
double hidden_by_digits(const ValueLevels& levels);

/// The levels less the finest value and over the greatest distance from it, so that no square of
/// theirs leaves the range of doubles. The scale is zero where the values are all the same.
struct ScaledLevels {
    ValueLevels levels;
    double origin = 0;
    double scale = 0;
};

ScaledLevels scaled(const ValueLevels& levels);

/// Next to a turn differences are small, as of a steeper order: that of the limit shows in three
/// and more behind it.
inline constexpr std::size_t fewest_past_a_turn = 4; // levels

/// The index of the last level at which the values turn back; 0 where they go one way.
std::size_t last_turn(const ValueLevels& levels);

/// The levels from the last turn on, where there are so many; else all.
ValueLevels past_the_turn(const ValueLevels& levels);

} // namespace tvbeam
