#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace tvbeam {

struct Cells;

/// A partition 0 = x_0 < x_1 < … < x_s = 1 of the beam; s ≥ 1.
struct Mesh {
    Eigen::ArrayXd nodes;   ///< x_0 … x_s; shape: s + 1
    Eigen::ArrayXd lengths; ///< h_j = x_j − x_{j−1}, j = 1 … s; shape: s

    /// The parts of the elements on which functions are integrated; null: the elements themselves.
    std::shared_ptr<const Cells> cells = nullptr;

    [[nodiscard]] Eigen::Index elements() const { return lengths.size(); }

    /// s elements of length 1/s. Throws std::invalid_argument when s < 1.
    static Mesh uniform(Eigen::Index elements);
};

/// A family of meshes that a ladder refines.
struct MeshFamily {
    /// x_j = (j/s)^grading: 1 is uniform, larger ones refine towards the clamped end; > 0.
    double grading = 1.0;

    /// Or nodes that every mesh has, 0 = X_0 < … < X_m = 1: each interval is cut into s/m equal
    /// elements. Empty: none.
    std::vector<double> nodes;

    [[nodiscard]] bool is_uniform() const { return grading == 1.0 && nodes.empty(); }

    /// The mesh of s elements. Throws std::invalid_argument when s < 1 or no multiple of m, and
    /// where an element has no length: of nodes in no order, or graded beyond what doubles tell
    /// apart.
    [[nodiscard]] Mesh with(Eigen::Index elements) const;
};

} // namespace tvbeam
