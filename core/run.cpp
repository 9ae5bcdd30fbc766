#include "core/run.hpp"

#include "core/contraction.hpp"
#include "core/hermite_form.hpp"
#include "core/moment_form.hpp"
#include "core/norms/error_norms.hpp"
#include "core/norms/quadrature_uncertainty.hpp"
#include "core/sine/form.hpp"
#include "core/time/time_levels.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tvbeam {

namespace {

/// Steps between two calls of RunRequest::advance.
constexpr std::int64_t steps_between = 64;

RunResult failure(RunResult result, const std::string& reason,
                  RunStatus status = RunStatus::failed) {
    result.status = status;
    result.reason = reason;
    result.errors.clear();
    return result;
}

bool all_finite(const std::vector<double>& errors) {
    return std::all_of(errors.begin(), errors.end(),
                       [](double error) { return std::isfinite(error); });
}

/// The loads that an algorithm integrates.
std::vector<const Field*> loads_of(const ProblemData& data, Algorithm algorithm) {
    return {&data.heat_source, &data.body_force,
            algorithm == Algorithm::direct ? &data.moment_load : &data.couple_load};
}

std::string located(const std::string& reason, std::int64_t step, std::int64_t steps, double t) {
    std::ostringstream text;
    text << reason << " in step " << step << " of " << steps << ", t = " << t;
    return text.str();
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
        if (const double rho = greatest_contraction(beam, mesh, scheme, dt); !(rho < 1.0)) {
            std::ostringstream reason;
            reason.precision(3);
            reason << "the fixed-point iteration would not contract: each of its iterations "
                      "multiplies the error by "
                   << rho << ", predicted; use the direct algorithm";
            throw std::domain_error(reason.str());
        }
        return std::make_unique<HermiteForm>(beam, data, mesh, scheme, dt);
    }
    return std::make_unique<MomentForm>(beam, data, mesh, scheme, dt, needs);
}

RunResult run(const RunRequest& request, const ProblemData& data, const Observer* observer) {
    RunResult result;
    const double dt = request.final_time / static_cast<double>(request.steps);
    bool wanted = true;
    const auto advance = [&](std::int64_t steps) {
        wanted = wanted && (!request.advance || request.advance(steps));
        return wanted;
    };
    const auto interrupted = [&] {
        return failure(std::move(result), "it was interrupted", RunStatus::interrupted);
    };
    if (!advance(0))
        return interrupted();
    try {
        const auto found = data.resolution ? data.resolution
                                           : std::make_shared<const Resolution>(
                                                 resolution_of(data, {request.scheme.algorithm},
                                                               request.norms, request.final_time));
        const Mesh mesh = found->on(request.mesh);
        const auto measured = [&](std::vector<double> errors) {
            result.errors = std::move(errors);
            if (!result.errors.empty())
                result.uncertainties = quadrature_uncertainties(
                    data, loads_of(data, request.scheme.algorithm), *found, mesh, request.norms,
                    result.errors, request.final_time);
        };
        Needs needs = ErrorNorms::needs(data, request.norms);
        if (observer != nullptr)
            needs = request.norms.empty() ? observer->needs : needs.with(observer->needs);
        else if (SineForm::suits(data, mesh, request.scheme, request.norms)) {
            SineForm form(request.beam, data, mesh, request.scheme, request.final_time,
                          request.steps, request.norms, needs);
            const bool finite = form.march(advance);
            if (!wanted)
                return interrupted();
            if (finite) {
                result.counters = form.counters();
                if (!request.norms.empty())
                    measured(form.errors());
                if (all_finite(result.errors))
                    return result;
            }
            // What is wrong, and where, the general form says.
            result = {};
        }
        const auto solver = make_solver(request.beam, data, mesh, request.scheme, dt, needs);
        std::optional<ErrorNorms> norms;
        if (!request.norms.empty())
            norms.emplace(request.beam, data, mesh, request.norms,
                          dynamic_cast<const MomentForm*>(solver.get()));

        if (observer != nullptr)
            observer->visit(0.0, *solver);
        TimeLevels levels(data, request.scheme.time, request.final_time, request.steps);
        for (std::int64_t n = 1; n <= request.steps; ++n) {
            const StepSources sources = levels.at(n);
            const std::string reason = solver->step(sources);
            if (!reason.empty()) {
                result.counters = solver->counters();
                return failure(result, located(reason, n, request.steps, levels.time(n)));
            }
            // The last solve of a step is at its end.
            if (norms)
                norms->add(levels.time(n), dt, *solver,
                           sources.amplitudes.col(sources.amplitudes.cols() - 1));
            if (observer != nullptr)
                observer->visit(levels.time(n), *solver);
            if (n % steps_between == 0 && !advance(steps_between))
                return interrupted();
        }
        result.counters = solver->counters();
        if (norms) {
            measured(norms->values());
            result.counters.norm_evaluations = norms->evaluations();
            result.counters.doubles_allocated += norms->doubles_allocated();
            if (!all_finite(result.errors))
                return failure(result, "an error norm is not finite at the end of the run");
        }
    } catch (const std::domain_error& error) {
        return failure(result, error.what());
    } catch (const std::bad_alloc&) {
        return failure(result, "not enough memory for " + std::to_string(request.mesh.elements()) +
                                   " elements");
    }
    return result;
}

} // namespace tvbeam
