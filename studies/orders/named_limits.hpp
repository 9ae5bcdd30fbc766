/// The limits and uncertainties of values by the methods that have names, as their authors give
/// them: for comparison beside the engine's own (limit_engine.hpp).
#pragma once

#include "studies/orders/limit_model.hpp"

#include <optional>
#include <span>
#include <string>

namespace tvbeam {

/// A named method's own figure: the limit it goes to and its uncertainty of the finest value.
struct MethodLimit {
    double limit = 0;
    double uncertainty = 0;
    double order = 0; ///< NaN where the model has none
    std::string model;
};

/// What a named method says, or why it says nothing.
struct MethodAnswer : std::optional<MethodLimit> {
    using std::optional<MethodLimit>::optional;
    std::string silence; ///< empty: it was not asked
};

// Levels: coarse to fine, of different widths, finite.

/// Of the three finest levels; none where they oscillate, stand still or run apart.
std::optional<double> order_of_finest(std::span<const ValueRow> levels);

/// The three finest levels; none either where their steps are all but the same.
MethodAnswer gci_of(std::span<const ValueRow> levels);
/// The same levels, with the order of |ε_32 / ε_21| and its sign (their eq. 3): oscillation too.
MethodAnswer celik_of(std::span<const ValueRow> levels);
/// Least squares, weighted by 1/h and not, of the four models of Eça and Hoekstra; four levels.
MethodAnswer eca_hoekstra_of(std::span<const ValueRow> levels);

} // namespace tvbeam
