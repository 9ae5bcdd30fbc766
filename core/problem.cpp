#include "core/problem.hpp"

#include <cmath>

namespace tvbeam {

bool Stops::exist() const {
    return std::isfinite(lower) || std::isfinite(upper);
}

} // namespace tvbeam
