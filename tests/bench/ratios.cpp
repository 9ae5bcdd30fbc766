#include "tests/bench/ratios.hpp"

#include "tests/bench/bounds.hpp"
#include "tests/bench/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tvbeam::bench {

namespace {

Wanted at_most(double bound) {
    return {.at_most = bound};
}

Wanted at_least(double bound) {
    return {.at_least = bound};
}

Section table1() {
    const Share sweeps{"sweeps"};
    return {"Table 1 with both norms, over bare Thomas sweeps of its sizes",
            {
                {"run()", {"full"}, sweeps, at_most(0.3)},
                {"run(), nodal basis", {"nodal"}, sweeps},
                {"the process tvbeam run table1", {"process"}, sweeps, at_most(0.8)},
                {"  wall clock", {"process"}, sweeps, at_most(0.8), Reading::wall},
                {"  wall clock, --jobs 2 over one job",
                 {"process, two jobs"},
                 {"process"},
                 {},
                 Reading::wall},
            }};
}

Section all_norms() {
    return {"Table 1 with all ten norms, over Table 1 with its two",
            {
                {"run()", {"all norms"}, {"full"}, at_most(3.0)},
                {"run(), nodal basis", {"nodal all norms"}, {"nodal"}},
            }};
}

Section left_out() {
    const Share full{"full"};
    return {"Left out, over the full scene of Table 1",
            {
                {"alpha = 0", {"no coupling"}, full, at_most(0.95)},
                {"no stops", {"no stops"}, full, at_most(0.95)},
                {"no norms", {"no norms"}, full, at_most(0.95)},
            }};
}

/// What a node and step costs. The set-up is taken off: it is the run of one step.
Share node_step(const std::string& basis, const March& march) {
    return {named(basis, march),
            static_cast<double>(march.steps - 1) * static_cast<double>(march.elements),
            named(basis, {march.elements, 1})};
}

/// Memory is judged from s = 1000 on: a block of steps holds some thousand doubles, whatever s is.
Section sizes(const std::string& basis, const std::vector<March>& marches) {
    Section section{fmt::format("Sizes, {} basis, both norms", basis), {}};
    const March& first = marches.front();
    for (const auto& march : marches) {
        const auto s = static_cast<double>(march.elements);
        const March one{march.elements, 1};
        const March twice{march.elements, 2 * march.steps};
        if (&march != &first)
            section.ratios.push_back(
                {fmt::format("node and step, s = {} over {}", march.elements, first.elements),
                 node_step(basis, march), node_step(basis, first), at_most(3.0)});
        section.ratios.push_back(
            {fmt::format("{} steps over {}, s = {}", twice.steps, march.steps, march.elements),
             {named(basis, twice), 1.0, named(basis, one)},
             {named(basis, march), 1.0, named(basis, one)},
             {1.8, 2.2}});
        section.ratios.push_back({fmt::format("doubles a node, s = {}", march.elements),
                                  {named(basis, march), s},
                                  {""},
                                  march.elements < 1000 ? Wanted{} : at_most(30.0),
                                  Reading::doubles});
        section.ratios.push_back(
            {fmt::format("set-up over a step, s = {}", march.elements),
             {named(basis, one)},
             {named(basis, march), static_cast<double>(march.steps - 1), named(basis, one)}});
    }
    return section;
}

Section fixed_point(const std::vector<March>& marches) {
    Section section{"The paper's fixed point over the direct algorithm, both norms", {}};
    for (const auto& march : marches)
        section.ratios.push_back({fmt::format("s = {}, {} steps", march.elements, march.steps),
                                  {named("fixed point", march)},
                                  {named("direct", march)},
                                  at_least(20.0)});
    return section;
}

Section variants(const March& march) {
    const auto over = [&](const std::string& what, const std::string& one,
                          const std::string& other) -> Ratio {
        return {what, {named(one, march)}, {named(other, march)}};
    };
    return {
        fmt::format("Variants, s = {}, {} steps, both norms", march.elements, march.steps),
        {
            over("nodal over sine basis", "nodal euler", "euler"),
            over("consistent over lumped mass", "consistent", "euler"),
            over("consistent over lumped mass, nodal", "nodal consistent", "nodal euler"),
            over("BDF2 over Euler", "bdf2", "euler"),
            over("BDF2 over Euler, nodal", "nodal bdf2", "nodal euler"),
            over("SDIRK2 over Euler", "sdirk2", "euler"),
            over("SDIRK2 over Euler, nodal", "nodal sdirk2", "nodal euler"),
            over("general over separable sources", "general sources", "euler"),
            over("general over separable sources, nodal", "nodal general sources", "nodal euler"),
        }};
}

Section low_rank(const std::vector<March>& marches) {
    Section section{"Sources that do not separate, by products, over Table 1's, set-up included",
                    {}};
    for (const auto& march : marches)
        for (const auto& [what, setting] : of_low_rank())
            for (const std::string basis : {"", "nodal "})
                section.ratios.push_back({fmt::format("{}{}, s = {}, {} steps", basis, what,
                                                      march.elements, march.steps),
                                          {named(basis + what, march)},
                                          {named(basis + "separable", march)},
                                          at_most(!basis.empty()          ? 2.5
                                                  : march.elements < 1000 ? 10.0
                                                                          : 5.0)});
    return section;
}

Section second_order(const March& euler, const std::vector<std::int64_t>& steps) {
    Section section{fmt::format("No norms, s = {}", euler.elements), {}};
    for (const std::int64_t n : steps)
        section.ratios.push_back({fmt::format("Euler, {} steps, over BDF2, {}", euler.steps, n),
                                  {named("no norms", euler)},
                                  {named("bdf2", {euler.elements, n})},
                                  at_least(50.0)});
    section.ratios.push_back({"set-up over one Thomas sweep",
                              {named("no norms", {euler.elements, 1})},
                              {named("sweeps", euler), static_cast<double>(euler.steps)},
                              at_most(30.0)});
    return section;
}

/// What one core does at most, and how near the steps come to it; README.md counts what they take.
Section bounds(const Extent& extent) {
    const double flops = static_cast<double>(rounds_of_vector_unit * flops_of_a_round());
    const double bytes = static_cast<double>(streamed_bytes) * static_cast<double>(extent.streamed);
    Section section{"Bounds of one core",
                    {
                        {"vector unit, Gflop/s", {""}, {"vector unit", flops / 1e9}},
                        {"memory, GB/s", {""}, {"stream", bytes / 1e9}},
                    }};
    // With both norms, of the modes that only the moment arm loads, contact in 0.29 of the steps.
    constexpr double sine_flops = 26.0;
    for (const auto& march : extent.sine_sizes)
        section.ratios.push_back(
            {fmt::format("sine basis, s = {}, of its flops at that", march.elements),
             {"vector unit", flops / sine_flops},
             node_step("sine", march)});
    constexpr double nodal_bytes = 8.0 * 66.0;
    for (const auto& march : extent.nodal_sizes)
        section.ratios.push_back(
            {fmt::format("nodal basis, s = {}, of its bytes at that", march.elements),
             {"stream", bytes / nodal_bytes},
             node_step("nodal", march)});
    return section;
}

using Pick = double (*)(std::vector<double>);

double least(std::vector<double> values) {
    return *std::min_element(values.begin(), values.end());
}

double middle(std::vector<double> values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

std::optional<double> value(const Share& share, const Measurements& measurements, Reading reading,
                            Pick pick) {
    if (share.name.empty())
        return 1.0;
    const auto values = measurements.of(share.name, reading);
    if (values.empty())
        return std::nullopt;
    double result = pick(values);
    if (!share.less.empty()) {
        const auto less = measurements.of(share.less, reading);
        if (less.empty())
            return std::nullopt;
        result -= pick(less);
    }
    return result / share.count;
}

std::optional<double> value(const Ratio& ratio, const Measurements& measurements, Pick pick) {
    const auto numerator = value(ratio.numerator, measurements, ratio.reading, pick);
    const auto denominator = value(ratio.denominator, measurements, ratio.reading, pick);
    if (!numerator || !denominator)
        return std::nullopt;
    return *numerator / *denominator;
}

std::string text(std::optional<double> value) {
    if (!value)
        return "-";
    return *value >= 100.0 ? fmt::format("{:.0f}", *value) : fmt::format("{:.3g}", *value);
}

std::string text(const Wanted& wanted) {
    if (wanted.at_least && wanted.at_most)
        return fmt::format("{} to {}", *wanted.at_least, *wanted.at_most);
    if (wanted.at_least)
        return fmt::format("≥ {}", *wanted.at_least);
    return wanted.at_most ? fmt::format("≤ {}", *wanted.at_most) : "";
}

bool missed(std::optional<double> value, const Wanted& wanted) {
    return value && ((wanted.at_least && !(*value >= *wanted.at_least)) ||
                     (wanted.at_most && !(*value <= *wanted.at_most)));
}

std::string row(const std::string& what, const std::string& ratio, const std::string& median,
                const std::string& wanted) {
    return fmt::format("{:<44} {:>7} {:>7}  {}\n", what, ratio, median, wanted);
}

} // namespace

std::vector<Section> sections(const Extent& extent) {
    return {table1(),
            left_out(),
            all_norms(),
            sizes("sine", extent.sine_sizes),
            sizes("nodal", extent.nodal_sizes),
            fixed_point(extent.fixed_point),
            variants(extent.compared),
            low_rank(extent.low_rank),
            second_order(extent.fine_euler, extent.second_order_steps),
            bounds(extent)};
}

std::string table(const std::vector<Section>& sections, const Measurements& measurements) {
    std::string lines = row("", "ratio", "median", "wanted");
    for (const auto& section : sections) {
        lines += fmt::format("\n{}\n", section.title);
        for (const auto& ratio : section.ratios) {
            const auto best = value(ratio, measurements, least);
            std::string wanted = text(ratio.wanted);
            if (missed(best, ratio.wanted))
                wanted += "  missed";
            lines += row("  " + ratio.what, text(best), text(value(ratio, measurements, middle)),
                         wanted);
        }
    }
    return lines;
}

} // namespace tvbeam::bench
