#include "studies/study.hpp"

#include "core/low_rank/separated.hpp"
#include "core/run.hpp"
#include "mms/forecast/smoothness.hpp"
#include "studies/evolution/evolution_block.hpp"
#include "studies/external/external_runs.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/phase_remarks.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/runs/defects.hpp"
#include "studies/runs/tolerance_remark.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace tvbeam {

Ending StudyResult::ending() const {
    Ending all;
    for (const auto& [kind, record] : records.entries()) {
        const Ending one = kind->ending(record);
        if ((one.failed && !all.failed) || (one.failures > 0 && all.failures == 0))
            all.reason = one.reason;
        all.failures += one.failures;
        all.interrupted = all.interrupted || one.interrupted;
        all.failed = all.failed || one.failed || one.interrupted;
    }
    if (all.failures > 1)
        all.reason = fmt::format("{} runs failed; the first, {}", all.failures, all.reason);
    return all;
}

std::vector<MeasuredRuns> StudyResult::runs() const {
    const Method own = scene.method();
    std::vector<MeasuredRuns> all;
    for (const auto& [kind, record] : records.entries()) {
        const auto results = kind->runs(record);
        if (results.empty())
            continue;
        const auto series = kind->series(*scene.blocks.find(*kind), own);
        for (std::size_t i = 0; i < results.size(); ++i)
            all.push_back({series[i], results[i]});
    }
    return all;
}

std::map<std::string, double> StudyResult::figures(const std::string& study) const {
    for (const auto& [kind, record] : records.entries())
        if (kind->name() == study)
            return kind->figures(record);
    return {};
}

namespace {

/// Of a reference run, and of the two coarser ones that it may be extrapolated from.
double work_of(const ReferenceBlock& reference, double final_time) {
    return static_cast<double>(reference.elements) * final_time / reference.dt *
           (reference.richardson ? 2.0 : 1.0);
}

} // namespace

double reference_work(const Scene& scene) {
    return scene.reference ? work_of(*scene.reference, longest_time(scene.measured_series())) : 0.0;
}

double work_of(const Scene& scene) {
    const Method own = scene.method();
    double work = reference_work(scene);
    for (const auto& [kind, block] : scene.blocks.entries())
        work += kind->work(block, own);
    return work;
}

namespace {

/// What is timed last; of the others the cheapest first: when time is short most of them are whole.
std::vector<const ByKind::Entry*> in_running_order(const Scene& scene, const Method& own) {
    std::vector<const ByKind::Entry*> order;
    for (const auto& entry : scene.blocks.entries())
        order.push_back(&entry);
    const auto key = [&](const ByKind::Entry* entry) {
        return std::pair(entry->kind->timed(), entry->kind->work(entry->value, own));
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto* a, const auto* b) { return key(a) < key(b); });
    return order;
}

std::vector<Algorithm> algorithms_of(const Scene& scene) {
    std::vector<Algorithm> algorithms{scene.scheme.algorithm};
    for (const auto& series : scene.series())
        algorithms.push_back(scheme_of(series.method).algorithm);
    return algorithms;
}

/// The most that a run of the scene makes of the final time, were it as long as the longest.
std::int64_t finest_steps(const Scene& scene) {
    double least = scene.reference ? scene.reference->dt : std::numeric_limits<double>::infinity();
    for (const auto& series : scene.series())
        for (const auto& rung : series.rungs)
            least = std::min(least, rung.dt);
    if (const auto* evolution = scene.get<EvolutionBlock>())
        least = std::min(least, evolution->rung.dt);
    constexpr double most = 1e9;
    return static_cast<std::int64_t>(std::min(scene.longest_time() / least, most));
}

/// The fixed-point algorithm checks the other, and so integrates G itself, whose formula lacks what
/// the moment of G has where a curvature or its viscous rate jumps.
void require_whole_load(const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr || solution->phases.empty())
        return;
    const AdmissibleSolution admissible(*solution, scene.beam, scene.longest_time());
    const auto kink = find_kink(admissible.derived(), scene.longest_time());
    if (kink &&
        (kink->of == Kink::Of::u_xx || (kink->of == Kink::Of::u_xxt && scene.beam.zeta != 0.0)))
        throw InputError(admissible.place().begin(),
                         words_of(*kink) + ": the formula of G lacks a delta function there, "
                                           "without which the fixed-point algorithm solves another "
                                           "problem; take the direct algorithm, or u without a "
                                           "kink");
}

/// The problem with what all runs share: how finely it is to be cut, and products in place of what
/// does not separate.
ProblemData prepared(const Scene& scene, const ProblemData& data, StudyResult& result) {
    ProblemData problem = data;
    if (!scene.poses_problem())
        return problem;
    const auto norms = norms_of(scene.measures());
    problem.resolution = std::make_shared<const Resolution>(
        resolution_of(data, algorithms_of(scene), norms, scene.longest_time()));
    if (!scene.defect) {
        result.quadrature = QuadratureResult{problem.resolution->intervals().size(), 1.0};
        for (const Interval& interval : problem.resolution->intervals())
            result.quadrature->finest = std::min(result.quadrature->finest, interval.length);
    }
    // The paper's algorithm checks the other, and so reads the functions themselves.
    const auto algorithms = algorithms_of(scene);
    if (std::ranges::find(algorithms, Algorithm::fixed_point) != algorithms.end()) {
        require_whole_load(scene);
        return problem;
    }
    SeparatedProblem products =
        separated(problem, norms, scene.longest_time(), finest_steps(scene));
    result.separation = {products.rank, products.residual, products.reason};
    return std::move(products.data);
}

std::string remark_on(const SeparationResult& separation) {
    if (separation.rank > 0)
        return fmt::format(
            "What does not separate into products of a function of t and one of x was replaced by "
            "{} such products, which differ from it by {:.1e} of its greatest value.",
            separation.rank, separation.residual);
    return separation.reason.empty()
               ? ""
               : "What does not separate into products of a function of t and one of x is "
                 "evaluated at every point in every step, which takes long: " +
                     separation.reason + ".";
}

/// (25) forms the curvature as a small difference of terms as large as α θ̃, and a tip between near
/// stops as a smaller one.
std::string remark_on_coupling(const Beam& beam) {
    const double rounding = beam.alpha * std::numeric_limits<double>::epsilon();
    const auto distance = [](double stop) { return stop == 0.0 ? 1.0 : std::abs(stop); };
    const double nearest = std::min({1.0, distance(beam.stops.lower), distance(beam.stops.upper)});
    constexpr double unseen = 1e-9;
    if (!(rounding * std::max(1.0, std::abs(beam.theta_A)) > unseen * nearest))
        return {};
    constexpr double all = 0.1;
    const std::string follows = "u_xx, the deflection, the contact stress and the energy";
    if (rounding > all)
        return fmt::format("alpha = {:g} multiplies the rounding of the temperature to all of its "
                           "size: nothing is known of {}.",
                           beam.alpha, follows);
    return fmt::format("alpha = {:g} multiplies the rounding of the temperature to about {:.1g} of "
                       "its greatest value: where {} are not far larger, they are rounding.",
                       beam.alpha, rounding, follows);
}

/// Published figures stay those of the file's problem, meshes and steps.
std::string remark_on_published(const Scene& scene) {
    const auto* ladder = scene.get<LadderBlock>();
    if (ladder == nullptr || !ladder->printed || ladder->printed->figures.empty())
        return {};
    const auto sets = [](const std::string& assignment, const std::string& key) {
        return assignment.starts_with(key + ".") || assignment.starts_with(key + "=");
    };
    std::string others;
    for (const auto& assignment : scene.overrides) {
        if (assignment.starts_with("ladder=") || sets(assignment, "ladder.printed"))
            return {};
        for (const char* key : {"beam", "solution", "data", "mesh", "ladder.elements", "ladder.dt",
                                "ladder.final_time", "solver"})
            if (sets(assignment, key))
                others += " --set " + assignment;
    }
    return others.empty() ? "" : "The published figures are of the scene without" + others + ".";
}

void run_studies(const StudyContext& context, StudyResult& result) {
    const Scene& scene = context.scene;
    for (const auto* entry : in_running_order(scene, context.method))
        result.records.set(*entry->kind, entry->kind->run(entry->value, context));
    if (std::string remark = remark_on_published(scene); !remark.empty())
        result.remarks.push_back(std::move(remark));
    for (auto& [kind, record] : result.records.entries())
        kind->conclude(*scene.blocks.find(*kind), record, result, context);
}

/// What is done once all is at hand that runs need.
using Conduct = std::function<void(const StudyContext&, StudyResult&)>;

/// A scene of a program that nobody here wrote.
StudyResult on_solver(const Scene& scene, const Execution& execution, const Conduct& conduct) {
    require_runnable(scene);
    StudyResult result{.scene = scene};
    const Keeper keeper;
    const StudiedSolver solver = external_runs(*scene.solver, keeper);
    const Method own = scene.method();
    if (const std::string remark = remark_on_untold_widths(*scene.solver, scene.series());
        !remark.empty())
        result.remarks.push_back(remark);
    const ProblemData no_data;
    const Defects no_defects;
    conduct({scene, no_data, solver, own, execution, no_defects}, result);
    return result;
}

StudyResult on_beam(const Scene& scene, const ProblemData& data, const Defects& defects,
                    const Execution& execution, const Conduct& conduct) {
    StudyResult result{.scene = scene, .law_distance = data.exact ? data.exact->law_distance : 0.0};
    const Method own = scene.method();
    const ProblemData resolved = prepared(scene, data, result);
    // What errors are measured against; others look at times that a reference does not know.
    ProblemData measured = resolved;
    if (scene.reference && !scene.measures().empty())
        result.reference = measure_against_reference(scene, measured, execution);
    StudiedSolver solver = beam_runs(scene, resolved, measured, defects);
    if (scene.poses_problem())
        result.remarks = phase_remarks(scene, data);
    if (!result.remarks.empty() && solver.roughness.empty())
        solver.roughness = "rates jump in time, or have an infinite slope, as is said below";
    if (result.reference && !result.reference->failure.empty())
        solver.rounding = {}; // runs of an earlier start have errors, and nothing says of what size
    if (scene.poses_problem()) {
        const ProblemData posed = defects.added_to(measured, scene.series().front().rungs.front());
        result.left_out = left_out({scene, posed, solver, own, execution, defects});
        if (const std::string remark = remark_on(result.separation); !remark.empty())
            result.remarks.push_back(remark);
        if (std::string remark = remark_on_coupling(scene.beam); !remark.empty())
            result.remarks.push_back(std::move(remark));
        if (data.exact && data.exact->tip_is_sampled)
            result.remarks.emplace_back(
                "That the exact solution's tip stays between the stops was seen at sampled times, "
                "and is not proven: a peak that is narrower than the time between them may pass a "
                "stop unseen.");
    }
    conduct({scene, resolved, solver, own, execution, defects}, result);
    for (const auto& [series, runs] : result.runs())
        if (std::string remark = tolerance_remark(scene, series, *runs, solver.run, execution);
            !remark.empty())
            result.remarks.push_back(std::move(remark));
    return result;
}

Defects defects_of(const Scene& scene) {
    return scene.defect ? Defects(*scene.defect, scene) : Defects();
}

ProblemData own_problem_of(const Scene& scene) {
    return scene.poses_problem() ? problem_of(scene, scene.longest_time()) : ProblemData{};
}

} // namespace

StudyResult run_study(const Scene& scene, const ProblemData& data, const Execution& execution) {
    require_runnable(scene, data);
    return run_study(scene, data, defects_of(scene), execution);
}

StudyResult run_study(const Scene& scene, const ProblemData& data, const Defects& defects,
                      const Execution& execution) {
    execution.expect(work_of(scene));
    return on_beam(scene, data, defects, execution, run_studies);
}

void require_runnable(const Scene& scene) {
    if (scene.solver)
        require_programs(*scene.solver, scene.series());
}

StudyResult run_study(const Scene& scene, const Execution& execution) {
    if (!scene.solver)
        return run_study(scene, own_problem_of(scene), execution);
    execution.expect(work_of(scene));
    return on_solver(scene, execution, run_studies);
}

void on_prepared(const Scene& scene, const Execution& execution,
                 const std::function<void(const StudyContext&)>& conduct) {
    const Conduct conducted = [&](const StudyContext& context, const StudyResult&) {
        conduct(context);
    };
    if (scene.solver) {
        on_solver(scene, execution, conducted);
        return;
    }
    const ProblemData data = own_problem_of(scene);
    require_runnable(scene, data);
    on_beam(scene, data, defects_of(scene), execution, conducted);
}

} // namespace tvbeam
