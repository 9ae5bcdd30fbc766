#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace tvbeam {

/// Numbers that all compilers draw alike.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : generator_(seed) {}
    std::uint64_t below(std::uint64_t count) { return generator_() % count; }
    double between(double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(generator_() >> 11U), -53);
    }
    /// Of variance one, by the central limit: sum of twelve.
    double normal() {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i)
            sum += between(0.0, 1.0);
        return sum;
    }

private:
    std::mt19937_64 generator_;
};

} // namespace tvbeam
