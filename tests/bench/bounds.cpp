#include "tests/bench/bounds.hpp"

namespace tvbeam::bench {

namespace {

/// Enough chains to cover what a fused product and sum takes, in two units.
constexpr int chains = 12;

template <typename Lanes>
[[gnu::always_inline]] inline double fill_with(std::int64_t rounds) {
    constexpr int lanes = sizeof(Lanes) / sizeof(double);
    const Lanes factor = Lanes{} + 0.5;
    Lanes sums[chains];
    for (int i = 0; i < chains; ++i)
        sums[i] = factor + i;
    for (std::int64_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 12 // else the sums are kept in memory
        for (int i = 0; i < chains; ++i)
            sums[i] = sums[i] * factor + factor;
    }
    double total = 0.0;
    for (const Lanes& sum : sums)
        for (int lane = 0; lane < lanes; ++lane)
            total += sum[lane];
    return total;
}

using TwoLanes [[gnu::vector_size(16)]] = double;

/// For one processor.
struct Unit {
    double (*fill)(std::int64_t rounds);
    std::int64_t lanes;
};

#if defined(__x86_64__) && !defined(__clang__)
using FourLanes [[gnu::vector_size(32)]] = double;
using EightLanes [[gnu::vector_size(64)]] = double;
[[gnu::target("arch=x86-64-v4")]] double fill_eight(std::int64_t rounds) {
    return fill_with<EightLanes>(rounds);
}
[[gnu::target("arch=x86-64-v3")]] double fill_four(std::int64_t rounds) {
    return fill_with<FourLanes>(rounds);
}
#endif

Unit unit() {
#if defined(__x86_64__) && !defined(__clang__)
    if (__builtin_cpu_supports("x86-64-v4") != 0)
        return {&fill_eight, 8};
    if (__builtin_cpu_supports("x86-64-v3") != 0)
        return {&fill_four, 4};
#endif
    return {&fill_with<TwoLanes>, 2};
}

} // namespace

double fill_the_vector_unit(std::int64_t rounds) {
    return unit().fill(rounds);
}

std::int64_t flops_of_a_round() {
    return 2 * chains * unit().lanes;
}

void stream(std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& c,
            double factor) {
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] = b[i] + factor * c[i];
}

} // namespace tvbeam::bench
