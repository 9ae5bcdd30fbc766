#pragma once

#include "tests/bench/settings.hpp"

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace tvbeam::bench {

/// How much is measured.
struct Extent {
    std::vector<March> table1;
    std::vector<March> sine_sizes; ///< for the cost of a node and step; the first is the reference
    std::vector<March> nodal_sizes;
    std::vector<March> fixed_point; ///< each against the direct algorithm
    March compared;                 ///< for schemes and sources against each other
    std::vector<March> low_rank;    ///< for sources that do not separate
    March fine_euler;               ///< against few steps of second order on the same mesh
    std::vector<std::int64_t> second_order_steps;
    std::size_t streamed; ///< numbers in each array, more than caches hold
    int repetitions;
    double seconds; ///< of one repetition, at least
};

Extent full_extent();
Extent short_extent(); ///< everything once, on small sizes

/// Something that is measured; ratios.cpp refers to it by its name.
struct Case {
    std::string name;
    std::function<void(benchmark::State&)> body;
};

std::vector<Case> cases(const Extent& extent);

/// The name of a case of one march: "direct s=80 n=16000".
std::string named(const std::string& what, const March& march);

/// Counters that cases leave.
inline constexpr auto doubles_counter = "doubles";             ///< Counters::doubles_allocated
inline constexpr auto processor_counter = "processor_seconds"; ///< of a process of its own

} // namespace tvbeam::bench
