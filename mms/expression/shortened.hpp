#pragma once

#include <ginac/ginac.h>

namespace tvbeam {

/// The same function in fewer letters, where multiplying out sums within it, or taking out what
/// their terms have in common, makes it so: 2 t x + t (x - 3) becomes 3 t (x - 1). For readers;
/// what is long (4000 letters) stays as it is.
GiNaC::ex shortened(const GiNaC::ex& expression);

} // namespace tvbeam
