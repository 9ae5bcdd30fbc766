#include "core/run.hpp"

#include "core/contraction.hpp"
#include "core/hermite_form.hpp"
#include "core/moment_form.hpp"
#include "core/norms/error_norms.hpp"
#include "core/norms/quadrature_uncertainty.hpp"
#include "core/norms/underflow.hpp"
#include "core/sine/sine_run.hpp"
#include "core/time/time_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

/// Steps between two calls of RunRequest::advance: few where each takes long.
std::int64_t steps_between(const Mesh& mesh) {
    constexpr std::int64_t most = 64;
    constexpr std::int64_t elements = 1 << 17; // about a millisecond's
    return std::clamp<std::int64_t>(elements / mesh.elements(), 1, most);
}

RunResult failure(const std::string& reason, const Counters& counters = {}) {
    return {.status = RunStatus::failed, .reason = reason, .counters = counters};
}

/// The loads that an algorithm integrates.
std::vector<const Field*> loads_of(const ProblemData& data, Algorithm algorithm) {
    return {&data.heat_source, &data.body_force,
            algorithm == Algorithm::direct ? &data.moment_load : &data.couple_load};
}

std::string located(const std::string& reason, std::int64_t step, std::int64_t steps, double t) {
    return fmt::format("{} in step {} of {}, t = {:g}", reason, step, steps, t);
}

} // namespace

Resolution resolution_of(const ProblemData& data, const std::vector<Algorithm>& algorithms,
                         const std::vector<Norm>& norms, double final_time) {
    std::vector<const Field*> fields{&data.curvature_initial};
    for (const Algorithm algorithm : algorithms)
        for (const Field* load : loads_of(data, algorithm))
            if (std::find(fields.begin(), fields.end(), load) == fields.end())
                fields.push_back(load);
    if (data.exact && data.exact->elements == 0) {
        const QuantitySet needed = quantities_of(norms);
        const auto exact = data.exact->fields();
        for (std::size_t q = 0; q < exact.size(); ++q)
            if (needed[q])
                fields.push_back(exact[q]);
    }
    return resolve(data, fields, final_time);
}

std::unique_ptr<Solver> make_solver(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                                    const Scheme& scheme, double dt, const Needs& needs) {
    if (scheme.algorithm == Algorithm::fixed_point) {
        // Whether a stop will hold the tip is not known before: what contracts held is tried.
        const bool has_stops = beam.stops.exist();
        const double free = greatest_contraction(beam, mesh, scheme, dt);
        const double held =
            has_stops ? greatest_contraction(beam, mesh, scheme, dt, Tip::held) : free;
        if (!(held < 1.0))
            throw std::domain_error(fmt::format(
                "the fixed-point iteration would not contract: each of its iterations multiplies "
                "the error by {:.3g}, predicted{}; use the direct algorithm",
                free,
                has_stops ? fmt::format(", and by {:.3g} where a stop holds the tip", held) : ""));
        return std::make_unique<HermiteForm>(beam, data, mesh, scheme, dt);
    }
    return std::make_unique<MomentForm>(beam, data, mesh, scheme, dt, needs);
}

namespace {

/// The run in nodal values.
RunResult march(const RunRequest& request, const ProblemData& data, const Mesh& mesh,
                const Needs& needs, const Observer* observer) {
    const double dt = request.final_time / static_cast<double>(request.steps);
    const auto solver = make_solver(request.beam, data, mesh, request.scheme, dt, needs);
    std::optional<ErrorNorms> norms;
    if (!request.norms.empty())
        norms.emplace(request.beam, data, mesh, request.norms,
                      dynamic_cast<const MomentForm*>(solver.get()));
    if (observer != nullptr)
        observer->visit(0.0, *solver);
    TimeLevels levels(data, request.scheme.time, request.final_time, request.steps);
    const std::int64_t between = steps_between(mesh);
    for (std::int64_t n = 1; n <= request.steps; ++n) {
        const StepSources sources = levels.at(n);
        const std::string reason = solver->step(sources);
        if (!reason.empty())
            return failure(
                located(reason, n, request.steps, levels.time(n)) +
                    (sources.amplitudes.allFinite()
                         ? ""
                         : ": a formula of the problem has no finite value in that step"),
                solver->counters());
        // The last solve of a step is at its end.
        if (norms)
            norms->add(levels.time(n), dt, *solver,
                       sources.amplitudes.col(sources.amplitudes.cols() - 1));
        if (observer != nullptr)
            observer->visit(levels.time(n), *solver);
        if (n % between == 0 && request.advance && !request.advance(between))
            return {.status = RunStatus::interrupted};
    }
    RunResult result{.counters = solver->counters()};
    if (norms) {
        result.errors = norms->values();
        result.counters.norm_evaluations = norms->evaluations();
        result.counters.doubles_allocated += norms->doubles_allocated();
    }
    if (const auto bad = std::ranges::find_if_not(
            result.errors, [](double error) { return std::isfinite(error); });
        bad != result.errors.end())
        return failure(
            fmt::format("{} is not finite at the end of the run: formulas of the solution, or of "
                        "its derivatives, have no value at a point of this mesh, or the square of "
                        "an error is too large",
                        request.norms[static_cast<std::size_t>(bad - result.errors.begin())].name),
            result.counters);
    return result;
}

/// What norms and observer read between them.
Needs needs_of(const RunRequest& request, const ProblemData& data, const Observer* observer) {
    if (observer != nullptr && request.norms.empty())
        return observer->needs;
    const Needs needs = ErrorNorms::needs(data, request.norms);
    return observer == nullptr ? needs : needs.with(observer->needs);
}

/// That the request is one of the model (1)–(10): what is not would run, and mean nothing.
void require_meaning(const RunRequest& request) {
    const auto& [alpha, zeta, theta_A, stops] = request.beam;
    const auto require = [](bool holds, const char* name, double value, const char* rule) {
        if (!holds)
            throw std::domain_error(fmt::format("{} is {:g}; it must be {}", name, value, rule));
    };
    require(request.steps >= 1, "steps", static_cast<double>(request.steps), "1 or more");
    require(request.final_time > 0.0 && std::isfinite(request.final_time), "final_time",
            request.final_time, "> 0 and finite");
    require(alpha >= 0.0 && std::isfinite(alpha), "alpha", alpha, ">= 0 and finite");
    require(zeta >= 0.0 && std::isfinite(zeta), "zeta", zeta, ">= 0 and finite");
    require(std::isfinite(theta_A), "theta_A", theta_A, "finite");
    require(stops.lower <= 0.0, "the lower stop", stops.lower, "<= 0");
    require(stops.upper >= 0.0, "the upper stop", stops.upper, ">= 0");
    require(stops.epsilon >= 0.0 && std::isfinite(stops.epsilon), "epsilon", stops.epsilon,
            ">= 0 and finite");
}

/// Either way of running.
RunResult attempt(const RunRequest& request, const ProblemData& data, const Observer* observer) {
    require_meaning(request);
    if (request.advance && !request.advance(0))
        return {.status = RunStatus::interrupted};
    const auto resolution =
        data.resolution ? data.resolution
                        : std::make_shared<const Resolution>(resolution_of(
                              data, {request.scheme.algorithm}, request.norms, request.final_time));
    const Mesh mesh = resolution->on(request.mesh);
    const Needs needs = needs_of(request, data, observer);
    std::optional<RunResult> result;
    if (observer == nullptr)
        result = run_in_sines(request, data, mesh, needs);
    if (!result)
        result = march(request, data, mesh, needs, observer);
    result->counters.integration_cells = integration_mesh(mesh).elements();
    if (result->errors.empty())
        return *std::move(result);
    if (const std::string reason =
            underflow(data, request.norms, result->errors, request.final_time);
        !reason.empty())
        return failure(reason, result->counters);
    result->uncertainties =
        quadrature_uncertainties(data, loads_of(data, request.scheme.algorithm), *resolution, mesh,
                                 request.norms, result->errors, request.final_time);
    return *std::move(result);
}

} // namespace

RunResult run(const RunRequest& request, const ProblemData& data, const Observer* observer) {
    try {
        RunResult result = attempt(request, data, observer);
        if (result.status == RunStatus::interrupted)
            result = {.status = RunStatus::interrupted, .reason = "it was interrupted"};
        return result;
    } catch (const std::domain_error& error) {
        return failure(error.what());
    } catch (const std::bad_alloc&) {
        return failure("not enough memory for " + std::to_string(request.mesh.elements()) +
                       " elements");
    }
}

} // namespace tvbeam
