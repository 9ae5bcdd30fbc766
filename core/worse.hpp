#pragma once

#include <cmath>

namespace tvbeam {

/// The greater of two. What is not a number is worse than every number, so that none is lost.
inline double worse(double a, double b) {
    return std::isnan(a) || b <= a ? a : b;
}

} // namespace tvbeam
