#pragma once

#include "studies/stress/stress_block.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace tvbeam {

/// The contraction of the fixed point over a map of (α, Δt), predicted (core/contraction.hpp) and
/// measured: the ratio of the third change of the temperature to the second in one solve, started
/// from θ = sin πx, of the time scheme without its starter. Shape: dt × alpha.
struct ContractionMap {
    ContractionBlock block;
    Eigen::ArrayXXd predicted;
    Eigen::ArrayXXd measured;
    /// Predicted, of a run, its first steps included: by which it is refused.
    Eigen::ArrayXXd greatest;

    /// From this prediction on, the third change is not lost in round-off.
    static constexpr double least_measurable = 1e-6;

    /// Of measured over predicted, where it can be measured. Not a number where that is nowhere.
    [[nodiscard]] double least_ratio() const;
    [[nodiscard]] double greatest_ratio() const;
    [[nodiscard]] Eigen::Index refused() const { return (greatest >= 1.0).count(); }
};

/// One row of the map: the same Δt, every α.
struct ContractionRow {
    std::vector<double> predicted;
    std::vector<double> measured;
    std::vector<double> greatest;
};

ContractionRow measure_contraction(const ContractionBlock& block, std::size_t row);

/// Of all its rows.
ContractionMap contraction_map(const ContractionBlock& block,
                               const std::vector<ContractionRow>& rows);

} // namespace tvbeam
