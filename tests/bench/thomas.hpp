#pragma once

#include <cstddef>
#include <vector>

namespace tvbeam::bench {

/// The yardstick: backward Euler for θ_t = θ_xx on s elements with a lumped mass, each step one
/// textbook Thomas sweep with precomputed multipliers and inverse pivots.
class ThomasSweep {
public:
    /// r = Δt/h²: the matrix is 1 + 2r on the diagonal and −r beside it.
    ThomasSweep(std::size_t elements, double r);

    [[nodiscard]] std::size_t unknowns() const { return inverse_pivots_.size(); }

    /// x ← A⁻¹ x.
    void solve(std::vector<double>& x) const;

private:
    std::vector<double> multipliers_;
    std::vector<double> inverse_pivots_;
};

} // namespace tvbeam::bench
