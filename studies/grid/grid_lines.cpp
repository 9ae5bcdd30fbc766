#include "studies/grid/grid_lines.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

namespace {

/// All lines that a grid within the budget may have.
GridLines longest_lines(const OrdersBlock& block) {
    const GridLines named = lines_of(block.grid);
    GridLines all = named;
    while (block.until->adds && (all.meshes.size() + 1) * named.steps.size() <= most_runs(block))
        if (const auto next = block.next_mesh(all.meshes))
            all.meshes.push_back(*next);
        else
            break;
    while (block.until->adds && named.meshes.size() * (all.steps.size() + 1) <= most_runs(block))
        if (const auto next = block.next_step(all.steps))
            all.steps.push_back(*next);
        else
            break;
    return all;
}

std::optional<GridLines> with_one_more(GridLines lines, std::vector<Rung> GridLines::*along,
                                       const NextLevel& next_level) {
    const auto next = next_level(lines.*along);
    if (!next)
        return std::nullopt;
    (lines.*along).push_back(*next);
    return lines;
}

} // namespace

Rung GridLines::run(std::size_t mesh, std::size_t step) const {
    return {meshes[mesh].elements, steps[step].steps, steps[step].dt};
}

std::vector<Rung> GridLines::grid() const {
    std::vector<Rung> all;
    for (std::size_t step = 0; step < steps.size(); ++step)
        for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh)
            all.push_back(run(mesh, step));
    return all;
}

std::vector<Rung> GridLines::last_mesh() const {
    return GridLines{{meshes.back()}, steps}.grid();
}

std::vector<Rung> GridLines::last_step() const {
    return GridLines{meshes, {steps.back()}}.grid();
}

GridLines lines_of(const std::vector<Rung>& grid) {
    GridLines lines;
    for (const Rung& run : grid) {
        if (run.dt == grid.front().dt)
            lines.meshes.push_back({.elements = run.elements});
        if (run.elements == grid.front().elements)
            lines.steps.push_back({.steps = run.steps, .dt = run.dt});
    }
    return lines;
}

std::optional<GridLines> with_mesh(const OrdersBlock& block, GridLines lines) {
    return with_one_more(std::move(lines), &GridLines::meshes, block.next_mesh);
}

std::optional<GridLines> with_step(const OrdersBlock& block, GridLines lines) {
    return with_one_more(std::move(lines), &GridLines::steps, block.next_step);
}

std::size_t most_runs(const OrdersBlock& block) {
    return static_cast<std::size_t>(block.until->most.value_or(most_levels));
}

std::size_t longest_line(const OrdersBlock& block) {
    const GridLines all = longest_lines(block);
    return std::max(all.meshes.size(), all.steps.size());
}

std::vector<Rung> addable_runs(const OrdersBlock& block) {
    const GridLines named = lines_of(block.grid);
    const GridLines all = longest_lines(block);
    std::vector<Rung> runs;
    for (std::size_t step = 0; step < all.steps.size(); ++step)
        for (std::size_t mesh = 0; mesh < all.meshes.size(); ++mesh) {
            const bool is_named = mesh < named.meshes.size() && step < named.steps.size();
            const std::size_t least =
                std::max(mesh + 1, named.meshes.size()) * std::max(step + 1, named.steps.size());
            if (!is_named && least <= most_runs(block))
                runs.push_back(all.run(mesh, step));
        }
    return runs;
}

std::vector<Rung> dearest_addition(const OrdersBlock& block,
                                   const std::function<double(const Rung&)>& cost) {
    const GridLines named = lines_of(block.grid);
    const GridLines all = longest_lines(block);
    std::vector<Rung> dearest;
    double most = 0.0;
    for (std::size_t meshes = named.meshes.size(); meshes <= all.meshes.size(); ++meshes) {
        const std::size_t steps = std::min(all.steps.size(), most_runs(block) / meshes);
        std::vector<Rung> added;
        double sum = 0.0;
        for (std::size_t step = 0; step < steps; ++step)
            for (std::size_t mesh = 0; mesh < meshes; ++mesh)
                if (mesh >= named.meshes.size() || step >= named.steps.size()) {
                    added.push_back(all.run(mesh, step));
                    sum += cost(added.back());
                }
        if (sum > most) {
            most = sum;
            dearest = std::move(added);
        }
    }
    return dearest;
}

} // namespace tvbeam
