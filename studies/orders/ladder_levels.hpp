/// The levels of a ladder: rows whose widths differ by less than an eighth are one.
#pragma once

#include "studies/orders/observed_order.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

/// Rows of one level, and the means of their logarithms.
struct Level {
    std::vector<std::size_t> rows;
    Refinement first;
    Refinement mean;
    double deviation = 0; ///< of the logarithm of the mean error; 0: not known
};

/// The rows that have an error that is known: a failed row in between is passed over. sigma:
/// standard deviations of the errors; empty: not known.
std::vector<Level> levels_of(std::span<const Refinement> ladder, std::span<const double> sigma);

/// By how much deviations of the errors may move the order between two levels, to 95 %.
double slack_between(const Level& from, const Level& to);

/// The orders between levels, and by how much each may be another.
struct Orders {
    std::vector<std::optional<double>> values;
    std::vector<double> slack;
};

Orders orders_of(const std::vector<Level>& levels);

/// The levels of each sweep, coarse to fine: all of them, or, where some levels share h and some
/// Δt, those of each h, then those of each Δt, and last what is in none. A level may be in two.
std::vector<std::vector<std::size_t>> sweeps_of(const std::vector<Level>& levels);

} // namespace tvbeam
