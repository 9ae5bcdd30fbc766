#include "reports/terminal_report.hpp"

#include "reports/evolution_text.hpp"
#include "reports/number_text.hpp"
#include "reports/orders_text.hpp"
#include "reports/scheme_text.hpp"
#include "reports/stress_text.hpp"
#include "reports/text_table.hpp"
#include "reports/work_precision_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace tvbeam {

namespace {

std::string stop_text(double value) {
    return std::isfinite(value) ? shortest(value) : "none";
}

std::string problem_line(const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    std::string line =
        (solution != nullptr ? "solution " + solution->name : std::string("given data")) +
        "; alpha = " + shortest(scene.beam.alpha) + ", zeta = " + shortest(scene.beam.zeta);
    if (scene.beam.theta_A != 0.0)
        line += ", theta_A = " + shortest(scene.beam.theta_A);
    if (scene.beam.stops.exist())
        line += ", stops " + stop_text(scene.beam.stops.lower) + " and " +
                stop_text(scene.beam.stops.upper);
    if (scene.beam.stops.epsilon != 0.0)
        line += ", penalised with epsilon = " + shortest(scene.beam.stops.epsilon) +
                (scene.has_exact_solution()
                     ? " (a solution that presses on a stop is one of rigid stops: its errors "
                       "then hold what the stop yields)"
                     : "");
    if (!scene.mesh.nodes.empty())
        line += "; nodes of every mesh: " + std::to_string(scene.mesh.nodes.size());
    else if (!scene.mesh.is_uniform())
        line += "; meshes graded by " + shortest(scene.mesh.grading);
    return line;
}

/// What errors are measured against, if not the exact solution.
std::string reference_line(const Scene& scene, const ReferenceResult& result) {
    const ReferenceBlock& block = *scene.reference;
    std::string line = std::string("errors against ") +
                       (block.richardson ? "a reference extrapolated (Richardson) from runs with "
                                         : "a reference run: ") +
                       "s = " + std::to_string(block.elements) + ", dt = " + shortest(block.dt);
    if (block.richardson)
        line += ", with half of s, and with twice dt";
    if (scene.has_exact_solution())
        line += "; not against the exact solution that the scene has";
    if (!result.failure.empty())
        line += "; it failed: " + result.failure;
    return line;
}

TextTable::Column column(const LadderResult& ladder, const std::string& heading,
                         const std::function<std::string(std::size_t)>& cell) {
    TextTable::Column result{heading, {}};
    for (std::size_t i = 0; i < ladder.rungs.size(); ++i)
        result.cells.push_back(cell(i));
    return result;
}

std::string ratio_text(double ratio) {
    return ratio >= 0.01 && ratio < 100.0 ? fixed(ratio, 4) : scientific(ratio, 1);
}

TextTable::Group norm_group(const LadderResult& ladder, const LadderBlock& block, std::size_t k) {
    const auto error = [&ladder, k](std::size_t i) {
        const auto& errors = ladder.rungs[i].errors;
        return errors.empty() ? std::optional<double>() : errors[k];
    };
    const std::string& name = ladder.norms[k].norm.name;
    TextTable::Group group{name, {}};
    group.columns.push_back(column(ladder, "error", [&](std::size_t i) {
        return error(i) ? scientific(error(i), 4) : std::string("failed");
    }));
    if (block.printed) {
        if (const auto found = block.printed->figures.find(name);
            found != block.printed->figures.end()) {
            const auto& figures = found->second;
            group.columns.push_back(column(
                ladder, "printed", [&](std::size_t i) { return scientific(figures[i], 3); }));
            group.columns.push_back(column(ladder, "ratio", [&](std::size_t i) {
                const auto value = error(i);
                return value && figures[i] != 0.0 ? ratio_text(*value / figures[i]) : std::string();
            }));
        }
    }
    group.columns.push_back(
        column(ladder, "ord.", [&](std::size_t i) { return fixed(ladder.norms[k].orders[i], 2); }));
    return group;
}

/// Two significant digits in at most four characters, up to a few hours.
std::string seconds_text(double seconds) {
    if (seconds < 0.0095)
        return scientific(seconds, 0);
    if (seconds < 0.995)
        return fixed(seconds, 2);
    return fixed(seconds, seconds < 99.95 ? 1 : 0);
}

std::string ladder_report(const LadderResult& ladder, const LadderBlock& block,
                          Algorithm algorithm) {
    TextTable::Group key{"", {}};
    key.columns.push_back(column(
        ladder, "s", [&](std::size_t i) { return std::to_string(ladder.rungs[i].rung.elements); }));
    key.columns.push_back(
        column(ladder, "dt", [&](std::size_t i) { return shortest(ladder.rungs[i].rung.dt); }));
    std::vector<TextTable::Group> groups;
    for (std::size_t k = 0; k < ladder.norms.size(); ++k)
        groups.push_back(norm_group(ladder, block, k));
    TextTable::Group cost{"", {}};
    if (algorithm == Algorithm::fixed_point)
        cost.columns.push_back(column(ladder, "iter.", [&](std::size_t i) {
            return std::to_string(ladder.rungs[i].counters.fixed_point_iterations);
        }));
    cost.columns.push_back(column(
        ladder, "sec", [&](std::size_t i) { return seconds_text(ladder.rungs[i].seconds); }));
    groups.push_back(cost);
    std::string text = TextTable(key, groups).text();
    if (block.printed && !block.printed->figures.empty())
        text += "\nprinted: " + block.printed->source +
                "; ratio: error / printed; ord.: observed order\n";
    for (const auto& rung : ladder.rungs)
        if (rung.status != RunStatus::ok)
            text += "\n" + wrapped(fmt::format("s = {}, dt = {} failed: {}", rung.rung.elements,
                                               shortest(rung.rung.dt), rung.reason));
    if (!ladder.reference_remark.empty())
        text += "\n" + wrapped(ladder.reference_remark);
    for (const auto& norm : ladder.norms)
        for (std::size_t i = 0; i < norm.remarks.size(); ++i)
            text += (i == 0 ? "\n" : "") + wrapped(norm.remarks[i]);
    return text;
}

} // namespace

std::string terminal_report(const StudyResult& result) {
    const Scene& scene = result.scene;
    std::string text = wrapped(scene.title);
    // A stress study has problems of its own.
    if (scene.poses_problem())
        text += wrapped(problem_line(scene));
    if (result.ladder || result.orders || result.evolution)
        text += wrapped(scheme_text(scene.scheme));
    if (result.reference)
        text += wrapped(reference_line(scene, *result.reference));
    if (result.ladder)
        text += wrapped("errors up to T = " + shortest(scene.ladder->final_time)) + "\n" +
                ladder_report(*result.ladder, *scene.ladder, scene.scheme.algorithm);
    if (result.orders)
        text += "\n" + orders_text(*result.orders);
    if (result.work_precision)
        text += "\n" + work_precision_text(*result.work_precision, *scene.work_precision);
    if (result.evolution)
        text += "\n" + evolution_text(*result.evolution, scene);
    if (result.stress)
        text += "\n" + stress_text(*result.stress);
    if (!result.left_out.empty()) {
        text += "\nLeft out, as the scene does not need it:\n";
        for (const auto& part : result.left_out)
            text += wrapped("  " + part, 4);
    }
    return text;
}

} // namespace tvbeam
