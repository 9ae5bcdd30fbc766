#pragma once

#include <Eigen/Core>

#include <cmath>

namespace tvbeam {

/// Whether all of them are finite. Their sum says so in one pass; where it overflows, they are
/// looked at one by one.
template <typename Derived>
bool are_finite(const Eigen::DenseBase<Derived>& values) {
    return std::isfinite(values.sum()) || values.allFinite();
}

} // namespace tvbeam
