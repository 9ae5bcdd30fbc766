#pragma once

#include "studies/stress.hpp"

#include <string>

namespace tvbeam {

/// The stress study for a terminal: outcomes by regime, the worst case of each check, the reasons
/// of what was refused or stopped, and the contraction map and round-off table where it has them.
std::string stress_text(const StressResult& result);

/// Every case as a line of CSV.
std::string stress_csv(const StressResult& result);

/// The name of a kind of initial data, as a scene gives it.
std::string name_of(InitialData initial);

} // namespace tvbeam
