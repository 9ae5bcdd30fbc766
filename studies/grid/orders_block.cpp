#include "studies/grid/orders_block.hpp"

#include "mms/text/toml_reader.hpp"

namespace tvbeam {

namespace {

constexpr std::size_t largest_grid = 1'000'000;

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
    table.finish();
    return orders;
}

} // namespace tvbeam
