// tvbeam_bench [--short] [--benchmark_…]: measures, and prints a table of ratios, each of two
// things measured in this run. The machine may be shared: repetitions are interleaved at random,
// times are of the processor unless the row says otherwise, and the first figure is of the least
// time of each, the second of the medians.

#include "tests/bench/cases.hpp"
#include "tests/bench/measurements.hpp"
#include "tests/bench/ratios.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace tvbeam::bench;

namespace {

/// Arguments of the user's, which come last, override these. The library keeps a pointer to the
/// program's name.
void initialise(const Extent& extent, char* program, const std::vector<std::string>& users) {
    std::vector<std::string> arguments{
        "--benchmark_enable_random_interleaving=true",
        fmt::format("--benchmark_repetitions={}", extent.repetitions),
        fmt::format("--benchmark_min_time={}", extent.seconds)};
    arguments.insert(arguments.end(), users.begin(), users.end());
    std::vector<char*> pointers{program};
    for (auto& argument : arguments)
        pointers.push_back(argument.data());
    int count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    if (benchmark::ReportUnrecognizedArguments(count, pointers.data()))
        std::exit(2);
}

} // namespace

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool is_short = std::erase(arguments, "--short") > 0;
    const Extent extent = is_short ? short_extent() : full_extent();
    initialise(extent, argv[0], arguments);
    for (const auto& [name, body] : cases(extent))
        benchmark::RegisterBenchmark(name.c_str(), body);

    Measurements measurements;
    benchmark::RunSpecifiedBenchmarks(&measurements);
    auto rows = sections(extent);
    if (is_short) // nothing is wanted of so little
        for (auto& section : rows)
            for (auto& ratio : section.ratios)
                ratio.wanted = {};
    fmt::print("{}", table(rows, measurements));
    for (const auto& [name, reason] : measurements.failures())
        fmt::print(stderr, "{}: {}\n", name, reason);
    return measurements.failures().empty() ? 0 : 1;
}
