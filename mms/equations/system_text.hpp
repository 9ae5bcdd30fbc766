#pragma once

#include "mms/equations/derived_system.hpp"

#include <string>

namespace tvbeam {

/// What was derived, to be read: the equations as they are written, in derivatives of the unknowns,
/// and with the exact solution put in where that is no longer than a few lines.
std::string system_text(const DerivedSystem& derived);

/// The same as an align* environment of LaTeX.
std::string system_latex(const DerivedSystem& derived);

} // namespace tvbeam
