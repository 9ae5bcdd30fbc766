/// The meshes and steps of a grid, and those that `until` may add to it.
#pragma once

#include "studies/grid/orders_block.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace tvbeam {

/// The lines of a grid, from coarse to fine: every mesh is run with every step.
struct GridLines {
    std::vector<Rung> meshes; ///< without steps
    std::vector<Rung> steps;  ///< without a mesh

    [[nodiscard]] std::size_t runs() const { return meshes.size() * steps.size(); }
    [[nodiscard]] Rung run(std::size_t mesh, std::size_t step) const;
    [[nodiscard]] std::vector<Rung> grid() const; ///< elements change fastest
    /// Those of the line that is the last mesh, or the last step.
    [[nodiscard]] std::vector<Rung> last_mesh() const;
    [[nodiscard]] std::vector<Rung> last_step() const;
};

/// Of a grid in which elements change fastest.
GridLines lines_of(const std::vector<Rung>& grid);

/// With one mesh, or one step, more; none where a run may not have it.
std::optional<GridLines> with_mesh(const OrdersBlock& block, GridLines lines);
std::optional<GridLines> with_step(const OrdersBlock& block, GridLines lines);

/// How many runs a grid with `until` may come to have.
std::size_t most_runs(const OrdersBlock& block);

/// How many runs a line of it may come to have.
std::size_t longest_line(const OrdersBlock& block);

/// Every run that `until` may add, in an order that does not depend on what is added first: by that
/// they are kept.
std::vector<Rung> addable_runs(const OrdersBlock& block);

/// Of all grids that `until` may lead to, the dearest: the runs that it has more than the block
/// names, by their costs.
std::vector<Rung> dearest_addition(const OrdersBlock& block,
                                   const std::function<double(const Rung&)>& cost);

} // namespace tvbeam
