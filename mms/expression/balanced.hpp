#pragma once

#include <ginac/ginac.h>

namespace tvbeam {

/// The same function, with quotients in which both sides grow without bound written so that none
/// does: e^z/(1 + e^z)^2, infinity over infinity where z is large, as 1/((e^-z + 1)(1 + e^z)), and
/// sinh(z)/cosh(z)^2 as tanh(z)/cosh(z). Derivatives of 1/(1 + e^z) and 1/cosh(z) are made of such.
GiNaC::ex balanced(const GiNaC::ex& expression);

} // namespace tvbeam
