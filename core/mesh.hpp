#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// A partition 0 = x_0 < x_1 < … < x_s = 1 of the beam; s ≥ 1.
struct Mesh {
    Eigen::ArrayXd nodes;   ///< x_0 … x_s; shape: s + 1
    Eigen::ArrayXd lengths; ///< h_j = x_j − x_{j−1}, j = 1 … s; shape: s

    [[nodiscard]] Eigen::Index elements() const { return lengths.size(); }

    /// s elements of length 1/s. Throws std::invalid_argument when s < 1.
    static Mesh uniform(Eigen::Index elements);
};

} // namespace tvbeam
