#pragma once

#include "mms/expression/canonical.hpp"

namespace tvbeam {

/// About how large an expression and its parts become for x and t in [0, 1], by the sizes of
/// coefficients and exponents: 1000^118, and (1000*x + 1)^118 with it, has the binary logarithm
/// 1176. A function of x or t that is bounded, or that grows slowly, counts as 1.
struct Magnitude {
    double whole = 0.0;   ///< of the value, as a binary logarithm
    double extreme = 0.0; ///< the largest size of such a logarithm, of a part or a product of parts
    double above = 0.0;   ///< what the value stays below, if x and t are not negative
};

Magnitude magnitude(const CanonicalNode& node);

/// Whether doubles have room for all intermediate results: no part is beyond 2^±500.
bool fits_doubles(const Magnitude& magnitude);

} // namespace tvbeam
