#pragma once

#include "tests/equations/differences.hpp"

#include <map>
#include <string>

namespace tvbeam::testing {

/// The sources of each shipped system, written a second time by hand: the exact solution as C++,
/// each operator by its indices, each derivative a difference.
const std::map<std::string, std::map<std::string, Function>>& counterparts();

} // namespace tvbeam::testing
