#pragma once

#include "reports/formats/junit_report.hpp"

#include <string>

namespace tvbeam {

/// A checked scene as text: one line when all holds; else one line for each violation: where, what,
/// expected, found.
std::string check_report(const CheckedScene& scene, bool coloured = false);

} // namespace tvbeam
