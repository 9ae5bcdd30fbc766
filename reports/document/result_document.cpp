#include "reports/document/result_document.hpp"

#include "mms/forecast/expected_orders.hpp"
#include "reports/files/provenance.hpp"
#include "reports/studies/study_report.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

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
                           scientific(law_distance, 1) + ", and " + stalling_errors(scene.beam) +
                           " do not fall to zero)"
                     : "");
    if (!scene.mesh.nodes.empty())
        line += "; nodes of every mesh: " + std::to_string(scene.mesh.nodes.size());
    else if (!scene.mesh.is_uniform())
        line += "; meshes graded by " + shortest(scene.mesh.grading);
    return line;
}

std::string defect_line(const GivenData& defect) {
    std::string line;
    for (const auto& [name, source] : named_parts(defect))
        line += fmt::format("{}{} + ({})", line.empty() ? "defect: " : "; ", name, source);
    return line;
}

/// In which unknowns the direct algorithm marched, where runs of one scheme show it.
std::string basis_words(const StudyResult& result) {
    std::int64_t steps = 0;
    std::int64_t sine_steps = 0;
    for (const auto& [kind, record] : result.records.entries())
        if (!kind->timed())
            for (const auto* runs : kind->runs(record))
                for (const auto& run : *runs) {
                    steps += run.count("steps");
                    sine_steps += run.count("sine_steps");
                }
    if (steps == 0 || result.scene.solver || result.scene.scheme.algorithm != Algorithm::direct)
        return "";
    return sine_steps == 0       ? ", nodal values"
           : sine_steps == steps ? ", sine basis"
                                 : ", sine basis or nodal values";
}

/// Whether a study runs the scene's own scheme.
bool has_own_scheme(const StudyResult& result) {
    const auto& entries = result.records.entries();
    return std::any_of(entries.begin(), entries.end(), [](const ByKind::Entry& entry) {
        return entry.kind->poses_problem() && !entry.kind->timed();
    });
}

/// What errors are measured against, if not the exact solution.
std::string reference_line(const Scene& scene, const ReferenceResult& result) {
    const ReferenceBlock& block = *scene.reference;
    std::string line =
        std::string("errors against ") +
        (block.richardson ? "a reference extrapolated (Richardson), as if smooth, from runs with "
                          : "a reference run: ") +
        "s = " + std::to_string(block.elements) + ", dt = " + shortest(block.dt);
    if (block.richardson)
        line += ", with half of s, and with twice dt";
    if (scene.scheme.algorithm != Algorithm::direct)
        line += ", by the direct algorithm";
    if (scene.has_exact_solution())
        line += "; not against the exact solution that the scene has";
    if (scene.defect)
        line += "; without the defect";
    if (!result.failure.empty())
        line += "; it failed: " + result.failure;
    return line;
}

using Rows = std::vector<std::pair<std::string, std::string>>;

/// But for those of another solver, of which their names are all that is known.
Rows norms_in_words(const StudyResult& result) {
    Rows rows;
    for (const auto& study : result.runs())
        for (const auto& norm : study.series.measures) {
            const std::pair row{norm.name, norm.words};
            if (norm.words != norm.name && std::find(rows.begin(), rows.end(), row) == rows.end())
                rows.push_back(row);
        }
    return rows;
}

} // namespace

std::vector<std::pair<std::string, std::string>>
provenance_rows(const Scene& scene, const std::vector<std::string>& overrides) {
    const Provenance p = provenance_of(scene);
    Rows rows{{"version", "tvbeam " + p.version},
              {"commit", p.commit},
              {"compiler", p.compiler},
              {"build", p.build_type},
              {"flags", p.flags},
              {"processor", p.processor},
              {"date", p.date},
              {"scene", p.scene_file}};
    for (const auto& assignment : overrides)
        rows.emplace_back("override", "--set " + assignment);
    return rows;
}

Document result_document(const StudyResult& result) {
    const Scene& scene = result.scene;
    Document document{scene.defect ? std::string(defect_words) + ": " + scene.title : scene.title,
                      {},
                      {},
                      result.left_out,
                      norms_in_words(result),
                      provenance_rows(scene, scene.overrides)};
    if (result.interrupted())
        document.head.emplace_back("INTERRUPTED: what stands here is what had finished");
    if (scene.defect)
        document.head.push_back(defect_line(*scene.defect));
    // A stress study has problems of its own.
    if (scene.poses_problem() && !scene.solver)
        document.head.push_back(problem_line(scene, result.law_distance));
    if (has_own_scheme(result))
        document.head.push_back(scene.method().words + basis_words(result));
    if (result.reference)
        document.head.push_back(reference_line(scene, *result.reference));
    std::size_t of_problem = 0; // sections on the scene's own problem, which come first
    for (const auto& [kind, record] : result.records.entries()) {
        for (auto& section : report_of(*kind).sections(result)) {
            document.head.insert(document.head.end(), section.head.begin(), section.head.end());
            document.sections.push_back(std::move(section));
        }
        of_problem = kind->poses_problem() ? document.sections.size() : of_problem;
    }
    if (!result.remarks.empty() && document.sections.empty())
        document.sections.push_back({"Remarks", {}});
    for (const auto& remark : result.remarks) {
        auto& blocks = document.sections[std::max<std::size_t>(of_problem, 1) - 1].blocks;
        blocks.emplace_back(BlankLine{});
        blocks.emplace_back(Finding{remark});
    }
    return document;
}

} // namespace tvbeam
