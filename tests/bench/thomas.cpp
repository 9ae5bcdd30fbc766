#include "tests/bench/thomas.hpp"

namespace tvbeam::bench {

ThomasSweep::ThomasSweep(std::size_t elements, double r)
    : multipliers_(elements - 1, 0.0), inverse_pivots_(elements - 1, 1.0 / (1.0 + 2.0 * r)) {
    for (std::size_t i = 1; i < unknowns(); ++i) {
        multipliers_[i] = -r * inverse_pivots_[i - 1];
        inverse_pivots_[i] = 1.0 / (1.0 + 2.0 * r + r * multipliers_[i]);
    }
}

void ThomasSweep::solve(std::vector<double>& x) const {
    const std::size_t n = unknowns();
    for (std::size_t i = 1; i < n; ++i)
        x[i] -= multipliers_[i] * x[i - 1];
    x[n - 1] *= inverse_pivots_[n - 1];
    for (std::size_t i = n - 1; i-- > 0;)
        x[i] = inverse_pivots_[i] * x[i] - multipliers_[i + 1] * x[i + 1];
}

} // namespace tvbeam::bench
