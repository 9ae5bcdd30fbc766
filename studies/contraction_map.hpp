#pragma once

#include "studies/stress_block.hpp"

#include <Eigen/Core>

namespace tvbeam {

/// The contraction of the fixed point over a map of (α, Δt), predicted (core/contraction.hpp) and
/// measured: the ratio of the third change of the temperature to the second in one solve, started
/// from θ = sin πx. Shape: dt × alpha.
struct ContractionMap {
    ContractionBlock block;
    Eigen::ArrayXXd predicted;
    Eigen::ArrayXXd measured;

    [[nodiscard]] double least_ratio() const { return (measured / predicted).minCoeff(); }
    [[nodiscard]] double greatest_ratio() const { return (measured / predicted).maxCoeff(); }
    [[nodiscard]] Eigen::Index refused() const { return (predicted >= 1.0).count(); }
};

ContractionMap measure_contraction(const ContractionBlock& block);

} // namespace tvbeam
