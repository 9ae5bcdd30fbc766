#include "studies/predicted_work.hpp"

#include "studies/evolution/evolution_block.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/stress/stress_block.hpp"
#include "studies/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tvbeam {

namespace {

constexpr double bytes_a_run = 1e3;
constexpr double bytes_a_node = 400.0;
constexpr double bytes_a_case = 100.0;

/// Cases go to the disk; what is dealt and kept of each are a few words.
void add_stress(const StressBlock& stress, PredictedWork& predicted) {
    predicted.runs += static_cast<double>(stress.cases());
    if (const auto& map = stress.contraction)
        predicted.runs +=
            static_cast<double>(map->alpha.size()) * static_cast<double>(map->dt.size());
    std::int64_t largest = 0;
    for (std::size_t i = 0; i < stress.cases(); ++i)
        largest = std::max(largest, stress.case_at(i).elements);
    predicted.bytes += bytes_a_case * static_cast<double>(stress.cases()) +
                       bytes_a_node * static_cast<double>(largest);
}

/// How often a sensitivity study runs all others: for each defect a scan of decades, and the
/// bisections between two of them.
double repetitions(const SensitivityBlock& block) {
    constexpr double bisections = 8.0;
    return static_cast<double>(block.defects.size()) *
           (std::log10(block.largest) - std::log10(block.smallest) + bisections);
}

std::string time_text(double seconds) {
    if (seconds < 120.0)
        return fmt::format("{:.2g} s", seconds);
    if (seconds < 120.0 * 60.0)
        return fmt::format("{:.0f} min", seconds / 60.0);
    return seconds < 1e9 ? fmt::format("{:.0f} h", seconds / 3600.0)
                         : fmt::format("{:.2g} years", seconds / (365.25 * 24.0 * 3600.0));
}

/// Seconds that the runs which `until` adds to a study may take.
double added_seconds(const Scene& scene, const ByKind::Entry& study) {
    const Until& until = *study.kind->until(study.value);
    const std::optional<double> timeout = scene.solver ? scene.solver->timeout : std::nullopt;
    const auto cost = [&](const Rung& rung) {
        return timeout ? *timeout : work_of(scene.method(), rung) / steps_a_second + seconds_a_run;
    };
    const auto added = study.kind->dearest_addition(study.value, cost);
    double seconds = 0.0;
    for (const Rung& rung : added)
        seconds += cost(rung);
    if (added.empty() || !until.seconds)
        return seconds;
    // What is added last may take longer than was thought: each of its runs as long as any.
    const auto last = static_cast<double>(study.kind->most_at_a_time(study.value));
    return std::min(seconds, *until.seconds + last * timeout.value_or(0.0));
}

/// What the whole may take that is not predicted: runs that are added, programs.
void bound(const Scene& scene, PredictedWork& predicted) {
    const auto& solver = scene.solver;
    std::string adding;
    double added = 0.0;
    for (const auto& study : scene.blocks.entries())
        if (study.kind->until(study.value) != nullptr) {
            const double seconds = solver && !solver->timeout ? 0.0 : added_seconds(scene, study);
            added += seconds;
            if (seconds > 0.0)
                adding += (adding.empty() ? "" : " and ") + study.kind->name() + ".until";
        }
    if (solver ? !solver->timeout : adding.empty())
        return;
    predicted.at_most = added + (solver ? predicted.runs * *solver->timeout : predicted.seconds);
    predicted.bounded_by = solver ? "by the time-out of each run"
                                  : fmt::format("with the runs that {} may add", adding);
}

} // namespace

std::string PredictedWork::text() const {
    return fmt::format("{:.2g} element steps in {:.6g} runs, about {} on one core and {:.0f} MB",
                       steps, runs, time_text(seconds), std::ceil(bytes / 1e6)) +
           (at_most > 0.0 ? fmt::format("; at most {} {}", time_text(at_most), bounded_by) : "");
}

PredictedWork predicted_work(const Scene& scene) {
    PredictedWork predicted;
    predicted.steps = work_of(scene);
    double largest = scene.reference ? static_cast<double>(scene.reference->elements) : 0.0;
    for (const auto& series : scene.series()) {
        predicted.runs += static_cast<double>(series.rungs.size());
        for (const Rung& rung : series.rungs)
            largest = std::max(largest, static_cast<double>(rung.elements));
    }
    if (scene.solver) { // what a program takes is known to nobody here
        predicted.steps = 0.0;
        largest = 0.0;
    }
    predicted.bytes = bytes_a_run * predicted.runs + bytes_a_node * largest;
    if (const auto* stress = scene.get<StressBlock>())
        add_stress(*stress, predicted);
    if (const auto* evolution = scene.get<EvolutionBlock>()) {
        const std::int64_t times = evolution->rung.steps / evolution->every;
        predicted.bytes += static_cast<double>(sizeof(double)) *
                           static_cast<double>(evolution->probes.size()) *
                           static_cast<double>(times);
    }
    if (const auto* sensitivity = scene.get<SensitivityBlock>()) {
        predicted.steps *= 1.0 + repetitions(*sensitivity);
        predicted.runs *= 1.0 + repetitions(*sensitivity);
    }
    predicted.seconds = predicted.steps / steps_a_second + predicted.runs * seconds_a_run;
    bound(scene, predicted);
    return predicted;
}

bool is_too_long(const Scene& scene, const PredictedWork& predicted) {
    return !scene.is_long &&
           !(predicted.seconds <= longest_work && predicted.bytes <= largest_work);
}

void require_short_enough(const Scene& scene, const PredictedWork& predicted) {
    if (!is_too_long(scene, predicted))
        return;
    throw InputError({scene.file},
                     fmt::format("asks for {}; beyond {} or {:.0f} MB it runs only with "
                                 "--yes-really-long, or long = true at the top of the scene",
                                 predicted.text(), time_text(longest_work), largest_work / 1e6));
}

} // namespace tvbeam
