#pragma once

#include "core/problem.hpp"
#include "mms/forecast/expected_orders.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// In sentences, why an order is not 2 in h, or 1 or 2 in dt: of all that is known but the orders.
std::vector<std::string> order_reasons(const ExpectedOrders& known, const Beam& beam);

} // namespace tvbeam
