#pragma once

#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// A refinement of a mesh, on whose parts the rule of six points integrates what it cannot on whole
/// elements: sharp profiles (Resolution), and the pieces of a computed solution on a finer mesh.
struct Cells {
    Mesh mesh; ///< the cells as elements
    std::vector<Eigen::Index>
        first;            ///< those of element j: first[j] … first[j + 1] − 1; shape: s + 1
    Eigen::ArrayXd left;  ///< ξ in [0, 1) of their left ends, in their elements
    Eigen::ArrayXd share; ///< their lengths over those of their elements
};

/// A part of [0, 1].
struct Interval {
    double left;
    double length;
};

/// The mesh with these cells: for every element its parts in ξ, in order.
Mesh with_cells(Mesh mesh, const std::vector<std::vector<Interval>>& parts);

/// The mesh with so many equal cells an element.
Mesh with_equal_cells(Mesh mesh, Eigen::Index parts);

/// The cells as a mesh: the mesh itself where it has none.
const Mesh& integration_mesh(const Mesh& mesh);

/// The cells of elements first … first + count − 1, one after the other.
struct CellRange {
    Eigen::Index first;
    Eigen::Index count;
};
CellRange cells_of(const Mesh& mesh, Eigen::Index first, Eigen::Index count);

/// ξ in its element of the place η in [0, 1] of a cell.
double in_element(const Mesh& mesh, Eigen::Index cell, double eta);

/// The end values on those cells of functions that are linear on each of the elements, from their
/// end values there; shapes: 2 × cells, 2 × count.
Eigen::Array2Xd at_cell_ends(const Mesh& mesh, Eigen::Index first, const Eigen::Array2Xd& ends);

/// The transpose of that: ∫ g (1 − ξ) dx, ∫ g ξ dx of each of the elements from the same of their
/// cells; shapes: 2 × count, 2 × cells.
Eigen::Array2Xd of_elements(const Mesh& mesh, Eigen::Index first, Eigen::Index count,
                            Eigen::Array2Xd moments);

} // namespace tvbeam
