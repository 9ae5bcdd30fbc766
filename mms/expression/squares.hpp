#pragma once

#include <ginac/ginac.h>

namespace tvbeam {

// For real g, g^(2k) (g²)^r = (g²)^(k + r): the one is 0/0 at g = 0 for r < 0, the other 0 there if
// k + r > 0. Derivatives of solutions with a kink, as g sqrt(g²), are of that kind.

/// A product with even powers of g joined to a negative fractional power of g²; any other
/// expression as it is.
GiNaC::ex with_joined_squares(const GiNaC::ex& product);

/// The same, and with s (g²)^(r + 1/2) for g (g²)^r where -1/2 <= r < 0 and g depends on x. The
/// sign s of g is 0 at g = 0, the mean of both sides. Of a g of t alone a step would take that mean
/// for its rate, and lose its order: there it stays without a value.
GiNaC::ex with_signs(const GiNaC::ex& product);

} // namespace tvbeam
