#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tvbeam::bench {

// What the processor can do at most, as far as one core of it shows.

/// So many rounds of products and sums that fill the widest vector unit from registers. Returns
/// something that depends on all of them.
double fill_the_vector_unit(std::int64_t rounds);
std::int64_t flops_of_a_round();
inline constexpr std::int64_t rounds_of_vector_unit = 100'000; ///< of a case

/// a ← b + f c. Bytes that pass: 32 a number, that of `a` twice, because what is written is read
/// first.
void stream(std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c,
            double factor);
inline constexpr std::int64_t streamed_bytes = 32;

} // namespace tvbeam::bench
