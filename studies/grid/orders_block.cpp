#include "studies/grid/orders_block.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/grid/grid_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace tvbeam {

namespace {

constexpr std::size_t largest_grid = 1'000'000;

/// Throws InputError where `until` could not go on as the meshes, or the steps, do.
void require_refined(const TableReader& table, const std::vector<Rung>& lines, const char* key) {
    const auto no_finer = [](const Rung& before, const Rung& after) {
        return after.elements <= before.elements && after.dt >= before.dt;
    };
    if (lines.size() < 2 || std::adjacent_find(lines.begin(), lines.end(), no_finer) != lines.end())
        throw table.error("until", std::string(" goes on as the meshes and the steps do: ") + key +
                                       " must hold at least two, from coarse to fine");
}

/// Lines that `until` adds go on as those of the lists do.
void read_refining(TableReader& table, OrdersBlock& orders) {
    auto inner = table.table("until");
    if (!inner)
        return;
    const GridLines lines = lines_of(orders.grid);
    require_refined(table, lines.meshes, "elements");
    require_refined(table, lines.steps, "dt");
    const auto at_least = [](const std::vector<Rung>& named) {
        return static_cast<std::int64_t>(std::max(least_known_levels, named.size()));
    };
    orders.until = read_until(
        *std::move(inner),
        {"runs", at_least(lines.meshes) * at_least(lines.steps),
         fmt::format("nothing is known of fewer than {0} meshes and {0} steps, and the grid names "
                     "{1} and {2}",
                     least_known_levels, lines.meshes.size(), lines.steps.size())});
    require_wanted(table, *orders.until, orders.norms, "the grid");
    orders.next_mesh = next_level(lines.meshes, orders.final_time);
    orders.next_step = next_level(lines.steps, orders.final_time);
}

} // namespace

OrdersBlock read_orders(TableReader& table, const SolverKeys& keys) {
    OrdersBlock orders;
    orders.final_time = read_final_time(table, keys);
    const auto elements = read_elements(table);
    const auto dt = table.numbers("dt");
    if (!dt || dt->empty())
        throw table.error("dt", " is missing or empty; give the steps that every mesh "
                                "is run with, e.g. [1e-2, 5e-3, 2.5e-3]");
    if (dt->size() > largest_grid / elements.size())
        throw table.error("dt", " has " + std::to_string(dt->size()) + " steps for " +
                                    std::to_string(elements.size()) +
                                    " meshes; a grid has at most " + std::to_string(largest_grid) +
                                    " runs");
    for (std::size_t j = 0; j < dt->size(); ++j)
        for (const std::int64_t s : elements)
            orders.grid.push_back({s, steps_of(table, j, orders.final_time, (*dt)[j]), (*dt)[j]});
    orders.norms = read_norms(table, keys);
    read_values(table, keys, orders.norms);
    if (orders.norms.empty())
        throw table.error("norms", " is missing or empty; name the norms whose orders are wanted");
    for (std::size_t i = 0; i < orders.norms.size(); ++i)
        if (orders.norms[i].name != orders.norms[i].root())
            throw table.error("norms",
                              " names the square '" + orders.norms[i].name +
                                  "'; the model is one of the norm itself: write " +
                                  orders.norms[i].root(),
                              i);
    read_refining(table, orders);
    table.finish();
    return orders;
}

} // namespace tvbeam
