#include "studies/runs/tolerance_remark.hpp"

#include "core/contraction.hpp"
#include "core/norms/norm_sums.hpp"
#include "studies/runs/beam_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

std::optional<IteratedError> least_beside_tolerance(const Scene& scene, const Series& series,
                                                    const std::vector<RungResult>& runs) {
    const Scheme& scheme = scheme_of(series.method);
    if (scheme.algorithm != Algorithm::fixed_point)
        return std::nullopt;
    std::optional<IteratedError> least;
    for (const auto& run : runs) {
        if (run.errors.empty())
            continue;
        const double rho = greatest_contraction(scene.beam, scene.mesh.with(run.rung.elements),
                                                scheme, run.rung.dt);
        const double adding_up = std::min(series.final_time, 1.0) / run.rung.dt;
        const double left = std::max(1.0, adding_up) * scheme.tolerance * rho / (1.0 - rho);
        for (std::size_t k = 0; k < series.measures.size(); ++k) {
            const Measure& measure = series.measures[k];
            const auto norm = Norm::named(measure.root());
            if (!norm || norm->quantities()[index(tvbeam::Quantity::stress)])
                continue;
            const double error = measure.squared ? std::sqrt(run.errors[k]) : run.errors[k];
            if (error > 0.0 && (!least || left > least->left * error))
                least = {left / error,
                         fmt::format("{} at s = {}, dt = {:.4g}, {:.2g}", measure.root(),
                                     run.rung.elements, run.rung.dt, error)};
        }
    }
    return least;
}

std::string tolerance_remark(const std::optional<IteratedError>& error) {
    constexpr double part = 0.1;
    if (!error || error->left < part)
        return {};
    return fmt::format(
        "What the fixed-point iteration leaves in its steps, by its tolerance and its "
        "contraction, may be {:.2g} times an error that it is part of ({}): that "
        "part has no order in h and dt, and what is said of orders may be wrong by "
        "it; take a smaller tolerance, or algorithm = \"direct\".",
        error->left, error->words);
}

} // namespace tvbeam
