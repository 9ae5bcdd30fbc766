#pragma once

#include "mms/text/key_table.hpp"

#include <vector>

namespace tvbeam {

/// The keys of [expect] and of the tables in it, in the order in which they are told of.
std::vector<KeyEntry> expectation_keys();

} // namespace tvbeam
