#include "reports/document/result_document.hpp"

#include "reports/document/evolution_section.hpp"
#include "reports/document/ladder_section.hpp"
#include "reports/document/norm_words.hpp"
#include "reports/document/number_text.hpp"
#include "reports/document/orders_section.hpp"
#include "reports/document/scheme_text.hpp"
#include "reports/document/stress_section.hpp"
#include "reports/document/work_precision_section.hpp"
#include "reports/files/provenance.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

std::string stop_text(double value) {
    return std::isfinite(value) ? shortest(value) : "none";
}

std::string problem_line(const Scene& scene, double law_distance) {
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
                (law_distance > 0.0
                     ? " (the solution is one of rigid stops; these would let its tip pass by up "
                       "to " +
                           scientific(law_distance, 1) + ", and errors do not fall to zero)"
                     : "");
    if (!scene.mesh.nodes.empty())
        line += "; nodes of every mesh: " + std::to_string(scene.mesh.nodes.size());
    else if (!scene.mesh.is_uniform())
        line += "; meshes graded by " + shortest(scene.mesh.grading);
    return line;
}

/// In which unknowns the direct algorithm marched, where runs of one scheme show it.
std::string basis_words(const StudyResult& result) {
    std::int64_t steps = 0;
    std::int64_t sine_steps = 0;
    const auto add = [&](const std::vector<RungResult>& runs) {
        for (const auto& run : runs) {
            steps += run.counters.steps;
            sine_steps += run.counters.sine_steps;
        }
    };
    if (result.ladder)
        add(result.ladder->rungs);
    if (result.orders)
        add(result.orders->runs);
    if (steps == 0 || result.scene.scheme.algorithm != Algorithm::direct)
        return "";
    return sine_steps == 0       ? ", nodal values"
           : sine_steps == steps ? ", sine basis"
                                 : ", sine basis or nodal values";
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

using Rows = std::vector<std::pair<std::string, std::string>>;

Rows norms_in_words(const StudyResult& result) {
    Rows rows;
    for (const auto& study : result.runs())
        for (const auto& norm : *study.norms) {
            const std::pair row{norm.name, norm_words(norm.name)};
            if (std::find(rows.begin(), rows.end(), row) == rows.end())
                rows.push_back(row);
        }
    return rows;
}

Rows provenance_rows(const Scene& scene) {
    const Provenance p = provenance_of(scene);
    Rows rows{{"version", "tvbeam " + p.version},
              {"commit", p.commit},
              {"compiler", p.compiler},
              {"build", p.build_type},
              {"flags", p.flags},
              {"processor", p.processor},
              {"date", p.date},
              {"scene", p.scene_file}};
    for (const auto& assignment : p.overrides)
        rows.emplace_back("override", "--set " + assignment);
    return rows;
}

} // namespace

Document result_document(const StudyResult& result) {
    const Scene& scene = result.scene;
    Document document{scene.title,           {}, {}, result.left_out, norms_in_words(result),
                      provenance_rows(scene)};
    if (result.interrupted())
        document.head.emplace_back("INTERRUPTED: what stands here is what had finished");
    // A stress study has problems of its own.
    if (scene.poses_problem())
        document.head.push_back(problem_line(scene, result.law_distance));
    if (result.ladder || result.orders || result.evolution)
        document.head.push_back(scheme_text(scene.scheme) + basis_words(result));
    if (result.reference)
        document.head.push_back(reference_line(scene, *result.reference));
    if (result.ladder) {
        document.head.push_back("errors up to T = " + shortest(scene.ladder->final_time));
        document.sections.push_back(ladder_section(*result.ladder, *scene.ladder, scene.scheme));
    }
    if (result.orders)
        document.sections.push_back(orders_section(*result.orders));
    if (result.work_precision)
        document.sections.push_back(
            work_precision_section(*result.work_precision, *scene.work_precision));
    if (result.evolution)
        document.sections.push_back(evolution_section(*result.evolution, scene));
    for (const auto& remark : result.remarks) {
        document.sections.back().blocks.emplace_back(BlankLine{});
        document.sections.back().blocks.emplace_back(Finding{remark});
    }
    if (result.stress)
        for (auto& section : stress_sections(*result.stress))
            document.sections.push_back(std::move(section));
    return document;
}

} // namespace tvbeam
