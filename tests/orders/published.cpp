// Tables of convergence that others published, with the orders that theory gives them.

#include "studies/orders/order_engine.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace tvbeam;

namespace {

/// Errors as printed, each mesh half as wide as the one before it.
struct Table {
    std::string name;
    double order;
    std::vector<double> errors;
    /// By all levels: pairwise orders in Linfty go 0.87, 1.75, 1.94 (Q1), where a logarithm would
    /// have 2.4, and 3.32, 2.63, 2.97 (Q2).
    bool determined;
};

OrderInterval order_of(const Table& table, std::size_t levels) {
    std::vector<ErrorRow> rows;
    for (std::size_t k = 0; k < levels; ++k)
        rows.push_back({{std::exp2(-static_cast<double>(k))}, table.errors[k]});
    return estimate_orders(rows)[0];
}

// deal.II, tutorial step-7, "Results" (https://www.dealii.org/current/doxygen/deal.II/step_7.html):
// Helmholtz, global refinement of 64 to 16384 cells; H1 is the seminorm. Elements Qk have k in it
// and k + 1 in L2.
const std::vector<Table> step_7{
    {"Q1 L2", 2, {1.840e+00, 3.570e-02, 1.192e-02, 3.047e-03, 7.660e-04}, true},
    {"Q1 H1", 1, {2.858e+00, 1.199e+00, 7.565e-01, 3.823e-01, 1.917e-01}, true},
    {"Q1 Linfty", 2, {1.835e+00, 1.307e-01, 7.168e-02, 2.128e-02, 5.554e-03}, false},
    {"Q2 L2", 3, {1.606e-01, 7.638e-03, 8.601e-04, 1.107e-04, 1.393e-05}, true},
    {"Q2 H1", 2, {1.278e+00, 5.248e-01, 1.086e-01, 2.756e-02, 6.915e-03}, true},
    {"Q2 Linfty", 3, {3.029e-01, 4.816e-02, 4.827e-03, 7.802e-04, 9.971e-05}, false}};

} // namespace

BOOST_AUTO_TEST_CASE(orders_of_the_tables_of_deal_ii_are_those_of_its_elements) {
    for (const auto& table : step_7) {
        // Without the last mesh the tables do not settle (Q1 in L2: 5.69, 1.58, 1.97).
        for (const std::size_t levels : {table.errors.size(), table.errors.size() - 1}) {
            const auto order = order_of(table, levels);
            BOOST_TEST_MESSAGE(table.name << ", " << levels << " levels: " << order.value << " in "
                                          << order.low << " ... " << order.high << " "
                                          << order.status);
            BOOST_TEST(order.low <= table.order, table.name);
            BOOST_TEST(table.order <= order.high, table.name);
            BOOST_TEST(order.determined == (table.determined && levels == table.errors.size()),
                       table.name);
            BOOST_TEST(std::abs(order.value - table.order) < 0.1, table.name);
        }
    }
}
