#pragma once

#include "mms/equations/equation_system.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// x, y, z, t
const std::vector<std::string>& coordinate_names();

/// diff, grad, …
const std::vector<std::string>& operator_names();

/// The names of a vector's components: v1, v2, v3; of one entry the name itself.
std::vector<std::string> component_names(const std::string& name, std::size_t count);

/// Throws InputError where a name is no identifier, hides a known one, is given twice, or reads as
/// a component or a derivative of another: with u, neither u_x nor u_exact may be a name.
void require_names(const EquationSystem& system);

} // namespace tvbeam
