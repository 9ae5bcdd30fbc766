#pragma once

#include <ginac/ginac.h>

namespace tvbeam {

/// The value of an expression without symbols. Throws AlgebraError if it is not a finite number.
double numeric_value(const GiNaC::ex& constant);

/// The double nearest to a rational. Throws AlgebraError if it is beyond the range; what is smaller
/// than the smallest normal double becomes 0.
double nearest_double(const GiNaC::numeric& rational);

} // namespace tvbeam
