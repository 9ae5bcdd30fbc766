#include "core/run.hpp"

#include "core/error_norms.hpp"
#include "core/hermite_form.hpp"
#include "core/moment_form.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace tvbeam {

namespace {

/// The amplitudes at t_1 … t_N, evaluated a block of levels at a time.
class AmplitudeBlocks {
public:
    AmplitudeBlocks(const ProblemData& data, double final_time, std::int64_t steps)
        : data_(data), final_time_(final_time), steps_(steps) {}

    [[nodiscard]] double time(std::int64_t n) const {
        return final_time_ * static_cast<double>(n) / static_cast<double>(steps_);
    }

    /// Valid until the next call.
    Eigen::Map<const Eigen::VectorXd> at(std::int64_t n) {
        if (data_.amplitude_count == 0)
            return {nullptr, 0};
        if (n >= first_ + values_.cols()) {
            const std::int64_t count = std::min<std::int64_t>(block, steps_ - n + 1);
            Eigen::ArrayXd times(count);
            for (std::int64_t k = 0; k < count; ++k)
                times(k) = time(n + k);
            values_ = data_.amplitudes(times);
            first_ = n;
        }
        return {values_.col(n - first_).data(), values_.rows()};
    }

private:
    static constexpr std::int64_t block = 256;
    const ProblemData& data_;
    double final_time_;
    std::int64_t steps_;
    std::int64_t first_ = 1;
    Eigen::ArrayXXd values_;
};

RunResult failure(RunResult result, const std::string& reason) {
    result.status = RunStatus::failed;
    result.reason = reason;
    result.errors.clear();
    return result;
}

std::string located(const std::string& reason, std::int64_t step, std::int64_t steps, double t) {
    std::ostringstream text;
    text << reason << " in step " << step << " of " << steps << ", t = " << t;
    return text.str();
}

} // namespace

std::unique_ptr<Solver> make_solver(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                                    const Scheme& scheme, double dt, const Needs& needs) {
    if (scheme.algorithm == Algorithm::fixed_point)
        return std::make_unique<HermiteForm>(beam, data, mesh, scheme, dt);
    return std::make_unique<MomentForm>(beam, data, mesh, scheme.thermal_mass, dt, needs);
}

RunResult run(const RunRequest& request, const ProblemData& data) {
    RunResult result;
    const double dt = request.final_time / static_cast<double>(request.steps);
    try {
        const Needs needs = ErrorNorms::needs(data, request.norms);
        const auto solver =
            make_solver(request.beam, data, request.mesh, request.scheme, dt, needs);
        std::optional<ErrorNorms> norms;
        if (!request.norms.empty())
            norms.emplace(request.beam, data, request.mesh, request.norms,
                          dynamic_cast<const MomentForm*>(solver.get()));

        AmplitudeBlocks amplitudes(data, request.final_time, request.steps);
        for (std::int64_t n = 1; n <= request.steps; ++n) {
            const double t = amplitudes.time(n);
            const auto now = amplitudes.at(n);
            const std::string reason = solver->step(t, now);
            if (!reason.empty()) {
                result.counters = solver->counters();
                return failure(result, located(reason, n, request.steps, t));
            }
            if (norms)
                norms->add(t, dt, *solver, now);
        }
        result.counters = solver->counters();
        if (norms) {
            result.errors = norms->values();
            result.counters.norm_evaluations = norms->evaluations();
            result.counters.doubles_allocated += norms->doubles_allocated();
            if (!std::all_of(result.errors.begin(), result.errors.end(),
                             [](double error) { return std::isfinite(error); }))
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
