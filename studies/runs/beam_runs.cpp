#include "studies/runs/beam_runs.hpp"

#include "core/contact/contact.hpp"
#include "core/run.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/resolution.hpp"
#include "mms/sample_points.hpp"
#include "studies/runs/round_off_remark.hpp"
#include "studies/scene/scene.hpp"
#include "studies/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <numbers>
#include <stdexcept>

namespace tvbeam {

namespace {

/// Of the fixed point over the direct algorithm: its iterations, and the solves with B.
constexpr double iterated = 20.0;

std::string time_scheme_text(const TimeScheme& scheme) {
    if (scheme.name == "euler")
        return "implicit Euler";
    std::string text = scheme.name;
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::vector<Count> counts_of(const Counters& counters) {
    return {{"steps", counters.steps},
            {"sine_steps", counters.sine_steps},
            {"heat_solves", counters.heat_solves},
            {"beam_solves", counters.beam_solves},
            {"coupling_updates", counters.coupling_updates},
            {"load_updates", counters.load_updates},
            {"source_evaluations", counters.source_evaluations},
            {"tip_evaluations", counters.tip_evaluations},
            {"contact_steps", counters.contact_steps},
            {"fixed_point_iterations", counters.fixed_point_iterations},
            {"norm_evaluations", counters.norm_evaluations},
            {"integration_cells", counters.integration_cells},
            {"doubles_allocated", counters.doubles_allocated}};
}

RungStatus status_of(RunStatus status) {
    return status == RunStatus::ok       ? RungStatus::ok
           : status == RunStatus::failed ? RungStatus::failed
                                         : RungStatus::interrupted;
}

} // namespace

Method method_of(const Scheme& scheme) {
    const bool direct = scheme.algorithm == Algorithm::direct;
    const bool lumped = scheme.thermal_mass == ThermalMass::lumped;
    return {.scheme = scheme,
            .name =
                scheme.time.name + ", " + name_of(scheme.algorithm) + (lumped ? ", lumped" : ""),
            .words = (direct ? "direct algorithm"
                             : "fixed-point algorithm, tolerance " + shortest(scheme.tolerance)) +
                     ", " + time_scheme_text(scheme.time) + ", " + name_of(scheme.thermal_mass) +
                     " heat mass matrix",
            .cost = static_cast<double>(scheme.time.stages.size()) * (direct ? 1.0 : iterated),
            .iterations = direct ? "" : "fixed_point_iterations"};
}

const Scheme& scheme_of(const Method& method) {
    return std::any_cast<const Scheme&>(method.scheme);
}

Measure measure_of(const Norm& norm) {
    return {norm.name, norm.squared, norm.words, norm.theorem};
}

std::vector<Norm> norms_of(const std::vector<Measure>& measures) {
    std::vector<Norm> norms;
    for (const auto& measure : measures) {
        const auto norm = Norm::named(measure.name);
        if (!norm)
            throw std::out_of_range("the beam has no norm " + measure.name);
        norms.push_back(*norm);
    }
    return norms;
}

RungResult rung_result(const Rung& rung, const RunResult& run, double seconds) {
    return {rung,
            status_of(run.status),
            run.reason,
            seconds,
            counts_of(run.counters),
            run.errors,
            run.uncertainties,
            run.counters.contact_changes > 0};
}

namespace {

/// Why no solution is smooth at t = 0; empty: nothing says so. Without viscosity, and soon where
/// there is little, w goes to the balance (2), (3), (7)–(9), and θ̃ − αw stays as it is:
///
///     (1 + α²)(w⁺ − w) = λ(1 − x) − (w + αθ̃ + μ)
///
/// At the ends (10) then keeps θ̃ from following, as it does where θ̃(0,0) ≠ θ_A.
std::string jump_at_start(const Scene& scene, const ProblemData& data) {
    if (!scene.reference || !data.resolution || data.exact)
        return {};
    using Eigen::ArrayXd;
    constexpr double rounding = 1e-9;
    const Beam& beam = scene.beam;
    const auto theta = [&](const ArrayXd& at) { return values(data, data.theta_initial, at, 0.0); };
    const auto w = [&](const ArrayXd& at) { return values(data, data.curvature_initial, at, 0.0); };
    const auto load = [&](const ArrayXd& at) { return values(data, data.moment_load, at, 0.0); };
    const ArrayXd x = sample_points(0.0, 1.0);
    const double hottest = theta(x).abs().maxCoeff();
    if (std::abs(theta(x)(0) - beam.theta_A) > rounding * std::max(hottest, std::abs(beam.theta_A)))
        return "theta0 is not theta_A at x = 0, so that the temperature jumps at t = 0";
    const double coupled = 1.0 + beam.alpha * beam.alpha;
    const double relaxation = beam.zeta / coupled;
    // The coarser of two steps that are extrapolated from.
    if (!(relaxation < 2.0 * scene.reference->dt))
        return {};
    const auto free_jump = [&](const ArrayXd& at) -> ArrayXd {
        return -(w(at) + beam.alpha * theta(at) + load(at)) / coupled;
    };
    const double compliance = 1.0 / (3.0 * coupled); // ∫ (1 − x)² dx
    const double free_tip =
        hat_loads(data.resolution->on(Mesh::uniform(1)),
                  [&](const ArrayXd& at) -> ArrayXd { return w(at) + free_jump(at); })(0);
    const double stress = contact_stress(beam.stops, free_tip, compliance);
    const ArrayXd jump = (free_jump(x) + stress / coupled * (1.0 - x)).abs();
    const double size =
        std::max({w(x).abs().maxCoeff(), std::abs(beam.alpha) * hottest, load(x).abs().maxCoeff()});
    if (beam.zeta == 0.0)
        return beam.alpha * std::max(jump(0), jump(jump.size() - 1)) > rounding * size
                   ? "u0 is not in balance with the other data, so that u_xx and with it the "
                     "temperature jump at t = 0"
                   : "";
    // What moves with the temperature, at rates of π², is as far off the balance.
    constexpr double slow = std::numbers::pi * std::numbers::pi;
    return jump.maxCoeff() > std::max(rounding, slow * beam.zeta) * size
               ? fmt::format(
                     "u0 is not in balance with the other data, so that u_xx relaxes within "
                     "about {:.2g} from t = 0, less than two of the reference's steps",
                     relaxation)
               : "";
}

/// Whether the tip is between the stops at t = 0: a run that is pressed in every step has met one.
bool starts_off_the_stops(const Scene& scene, const ProblemData& data) {
    const auto tip = initial_tip(data);
    if (!scene.beam.stops.exist() || !tip)
        return false;
    constexpr double rounding = 1e-9;
    const double most =
        rounding *
        values(data, data.curvature_initial, sample_points(0.0, 1.0), 0.0).abs().maxCoeff();
    return scene.beam.stops.lower + most < *tip && *tip < scene.beam.stops.upper - most;
}

} // namespace

std::optional<double> initial_tip(const ProblemData& data) {
    if (!data.resolution)
        return std::nullopt;
    return hat_loads(data.resolution->on(Mesh::uniform(1)), [&](const Eigen::ArrayXd& at) {
        return values(data, data.curvature_initial, at, 0.0);
    })(0);
}

StudiedSolver beam_runs(const Scene& scene, const ProblemData& data, const ProblemData& measured,
                        const Defects& defects) {
    const bool starts_off = starts_off_the_stops(scene, data);
    const auto run = [&scene, &measured, &defects, starts_off](const RunTask& task) {
        const ProblemData with_defect =
            defects.none() ? ProblemData{} : defects.added_to(measured, task.rung);
        const auto start = std::chrono::steady_clock::now();
        const RunResult run = tvbeam::run({.beam = scene.beam,
                                           .mesh = scene.mesh.with(task.rung.elements),
                                           .scheme = scheme_of(task.method),
                                           .final_time = task.final_time,
                                           .steps = task.rung.steps,
                                           .norms = norms_of(task.measures),
                                           .advance = task.advance},
                                          defects.none() ? measured : with_defect);
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        RungResult result = rung_result(task.rung, run, elapsed.count());
        result.has_kink = result.has_kink || (starts_off && run.counters.contact_steps > 0);
        // What the norms show of the reference against itself is the rounding of its evaluation.
        if (scene.reference && scene.reference->is(task.rung) && defects.none()) {
            std::fill(result.errors.begin(), result.errors.end(), 0.0);
            result.uncertainties.clear();
        }
        return result;
    };
    const auto remark = [&scene, &data](const Series& series, const std::vector<RungResult>& runs,
                                        std::size_t k) {
        return round_off_remark(scene.beam, data, series, runs, k);
    };
    const auto rounding = [&scene,
                           &measured](const Series& series, const std::vector<RungResult>& runs,
                                      const std::vector<RungResult>& refined, std::size_t k) {
        return rounding_errors(scene, measured, series, runs, refined, k);
    };
    return {.run = run,
            .reference = scene.reference,
            .remark = remark,
            .rounding = rounding,
            .has_defect = !defects.none(),
            .roughness = jump_at_start(scene, data)};
}

} // namespace tvbeam
