#include "tests/bench/cases.hpp"

#include "core/low_rank/separated.hpp"
#include "tests/bench/bounds.hpp"
#include "tests/bench/process.hpp"
#include "tests/bench/thomas.hpp"

#include <fmt/format.h>

#include <utility>

namespace tvbeam::bench {

namespace {

/// All marches of a setting, one after the other.
Case runs(std::string name, const Setting& setting, const std::vector<March>& marches) {
    const auto body = [setting, marches](benchmark::State& state) {
        std::vector<RunRequest> requests;
        requests.reserve(marches.size());
        for (const auto& march : marches)
            requests.push_back(request(setting, march));
        std::int64_t doubles = 0;
        for ([[maybe_unused]] const auto iteration : state)
            for (const auto& wanted : requests) {
                RunResult result = run(wanted, *setting.data);
                if (result.status != RunStatus::ok)
                    return state.SkipWithError(result.reason.c_str());
                doubles = result.counters.doubles_allocated;
                benchmark::DoNotOptimize(result);
            }
        state.counters[doubles_counter] = static_cast<double>(doubles);
    };
    return {std::move(name), body};
}

/// A study of one run, from the problem on: how finely it is cut, its products, the run.
Case study(const std::string& what, const Setting& setting, const March& march) {
    const auto body = [setting, march](benchmark::State& state) {
        const RunRequest wanted = request(setting, march);
        for ([[maybe_unused]] const auto iteration : state) {
            ProblemData problem = *setting.data;
            problem.resolution = std::make_shared<const Resolution>(resolution_of(
                problem, {setting.scheme.algorithm}, setting.norms, wanted.final_time));
            RunResult result =
                run(wanted, separated(problem, setting.norms, wanted.final_time).data);
            if (result.status != RunStatus::ok)
                return state.SkipWithError(result.reason.c_str());
            benchmark::DoNotOptimize(result);
        }
    };
    return {named(what, march), body};
}

Case single(const std::string& what, const Setting& setting, const March& march) {
    return runs(named(what, march), setting, {march});
}

void sweep(const ThomasSweep& thomas, std::int64_t steps, std::vector<double>& x) {
    x.assign(thomas.unknowns(), 1.0);
    for (std::int64_t n = 0; n < steps; ++n) {
        thomas.solve(x);
        benchmark::DoNotOptimize(x.data());
        benchmark::ClobberMemory();
    }
}

Case sweeps(std::string name, const std::vector<March>& marches) {
    std::vector<std::pair<ThomasSweep, std::int64_t>> all;
    for (const auto& [elements, steps] : marches) {
        const auto s = static_cast<double>(elements);
        const double dt = final_time / static_cast<double>(steps);
        all.emplace_back(ThomasSweep(static_cast<std::size_t>(elements), dt * s * s), steps);
    }
    const auto body = [all](benchmark::State& state) {
        std::vector<double> x;
        for ([[maybe_unused]] const auto iteration : state)
            for (const auto& [thomas, steps] : all)
                sweep(thomas, steps, x);
    };
    return {std::move(name), body};
}

/// The program as a user starts it.
Case process(std::string name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), TVBEAM_BINARY);
    const auto body = [arguments](benchmark::State& state) {
        double total = 0.0;
        for ([[maybe_unused]] const auto iteration : state) {
            const auto seconds = run_process(arguments);
            if (!seconds)
                return state.SkipWithError("the program failed");
            total += *seconds;
        }
        state.counters[processor_counter] =
            benchmark::Counter(total, benchmark::Counter::kAvgIterations);
    };
    return {std::move(name), body};
}

/// Per size: one step, which is what a run costs before it steps; then n and 2n steps.
void add_sizes(std::vector<Case>& all, const std::string& what, const Setting& setting,
               const std::vector<March>& marches) {
    for (const auto& [elements, steps] : marches)
        for (const std::int64_t n : {std::int64_t{1}, steps, 2 * steps})
            all.push_back(single(what, setting, {elements, n}));
}

void add_table1(std::vector<Case>& all, const std::vector<March>& ladder) {
    all.push_back(sweeps("sweeps", ladder));
    all.push_back(runs("full", full(), ladder));
    all.push_back(runs("nodal", in_nodal_basis(full()), ladder));
    all.push_back(process("process", {"run", "table1"}));
    all.push_back(process("process, two jobs", {"run", "table1", "--jobs", "2"}));
    all.push_back(runs("no coupling", without_coupling(), ladder));
    all.push_back(runs("no stops", without_stops(), ladder));
    all.push_back(runs("no norms", without_norms(), ladder));
    all.push_back(runs("all norms", with_all_norms(), ladder));
    all.push_back(runs("nodal all norms", in_nodal_basis(with_all_norms()), ladder));
}

void add_fixed_point(std::vector<Case>& all, const std::vector<March>& marches) {
    for (const auto& march : marches) {
        all.push_back(single("direct", full(), march));
        all.push_back(single("fixed point", by_fixed_point(), march));
    }
}

void add_variants(std::vector<Case>& all, const March& march) {
    const std::vector<std::pair<std::string, Setting>> variants{
        {"euler", full()},
        {"bdf2", with_time(full(), "bdf2")},
        {"sdirk2", with_time(full(), "sdirk2")},
        {"consistent", with_mass(full(), ThermalMass::consistent)},
        {"general sources", with_general_sources()},
    };
    for (const auto& [what, setting] : variants) {
        all.push_back(single(what, setting, march));
        all.push_back(single("nodal " + what, in_nodal_basis(setting), march));
    }
}

/// Each in both bases, and beside them the paper's problem, which separates.
void add_low_rank(std::vector<Case>& all, const std::vector<March>& marches) {
    for (const auto& march : marches) {
        all.push_back(study("separable", full(), march));
        all.push_back(study("nodal separable", in_nodal_basis(full()), march));
        for (const auto& [what, setting] : of_low_rank()) {
            all.push_back(study(what, setting, march));
            all.push_back(study("nodal " + what, in_nodal_basis(setting), march));
        }
    }
}

void add_second_order(std::vector<Case>& all, const March& euler,
                      const std::vector<std::int64_t>& steps) {
    all.push_back(single("no norms", without_norms(), euler));
    all.push_back(single("no norms", without_norms(), {euler.elements, 1}));
    all.push_back(sweeps(named("sweeps", {euler.elements, euler.steps}), {euler}));
    for (const std::int64_t n : steps)
        all.push_back(single("bdf2", with_time(without_norms(), "bdf2"), {euler.elements, n}));
}

void add_bounds(std::vector<Case>& all, std::size_t streamed) {
    all.push_back({"vector unit", [](benchmark::State& state) {
                       for ([[maybe_unused]] const auto iteration : state)
                           benchmark::DoNotOptimize(fill_the_vector_unit(rounds_of_vector_unit));
                   }});
    all.push_back({"stream", [streamed](benchmark::State& state) {
                       std::vector<double> a(streamed, 1.0);
                       const std::vector<double> b(streamed, 2.0);
                       const std::vector<double> c(streamed, 3.0);
                       for ([[maybe_unused]] const auto iteration : state) {
                           stream(a, b, c, 0.5);
                           benchmark::DoNotOptimize(a.data());
                           benchmark::ClobberMemory();
                       }
                   }});
}

} // namespace

Extent full_extent() {
    return {
        .table1 = {{10, 2000}, {20, 4000}, {40, 8000}, {80, 16000}, {160, 32000}},
        .sine_sizes = {{100, 51200}, {1000, 12800}, {10000, 2560}, {100000, 640}, {1000000, 640}},
        .nodal_sizes = {{100, 12800}, {1000, 3200}, {10000, 640}, {100000, 128}, {1000000, 64}},
        .fixed_point = {{10, 2000}, {20, 4000}, {40, 8000}, {80, 16000}, {160, 32000}},
        .compared = {160, 4000},
        .low_rank = {{160, 4000}, {1000, 4000}},
        .fine_euler = {160, 32000},
        .second_order_steps = {80, 160, 320},
        .streamed = std::size_t{1} << 23,
        .repetitions = 7,
        .seconds = 0.02};
}

Extent short_extent() {
    return {.table1 = {{10, 200}, {20, 400}},
            .sine_sizes = {{100, 64}, {1000, 64}},
            .nodal_sizes = {{100, 64}, {1000, 64}},
            .fixed_point = {{10, 200}},
            .compared = {20, 100},
            .low_rank = {{20, 100}},
            .fine_euler = {20, 400},
            .second_order_steps = {20},
            .streamed = std::size_t{1} << 12,
            .repetitions = 1,
            .seconds = 0.0};
}

std::string named(const std::string& what, const March& march) {
    return fmt::format("{} s={} n={}", what, march.elements, march.steps);
}

std::vector<Case> cases(const Extent& extent) {
    std::vector<Case> all;
    add_table1(all, extent.table1);
    add_sizes(all, "sine", full(), extent.sine_sizes);
    add_sizes(all, "nodal", in_nodal_basis(full()), extent.nodal_sizes);
    add_fixed_point(all, extent.fixed_point);
    add_variants(all, extent.compared);
    add_low_rank(all, extent.low_rank);
    add_second_order(all, extent.fine_euler, extent.second_order_steps);
    add_bounds(all, extent.streamed);
    return all;
}

} // namespace tvbeam::bench
