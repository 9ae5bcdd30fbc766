#include "studies/runs/tolerance_remark.hpp"

#include "core/contraction.hpp"
#include "studies/runs/beam_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

constexpr double part = 0.1; ///< of an error, from which on the iteration is said to be in it

/// What the iteration may leave in the unknowns.
double bound_of(const Scene& scene, const Scheme& scheme, double final_time, const Rung& rung) {
    const double rho =
        greatest_contraction(scene.beam, scene.mesh.with(rung.elements), scheme, rung.dt);
    const double adding_up = std::max(1.0, std::min(final_time, 1.0) / rung.dt);
    return adding_up * scheme.tolerance * rho / (1.0 - rho);
}

} // namespace

std::string tolerance_remark(const Scene& scene, const Series& series,
                             const std::vector<RungResult>& runs, const RunCall& run,
                             const Execution& execution) {
    Scheme scheme = scheme_of(series.method);
    if (scheme.algorithm != Algorithm::fixed_point || runs.empty() || runs.back().errors.empty())
        return {};
    const RungResult& last = runs.back();
    const double bound = bound_of(scene, scheme, series.final_time, last.rung);
    const auto may_be_in = [&](std::size_t k) {
        const double error = series.measures[k].root_of(last.errors[k]);
        return error > 0.0 && bound >= part * error;
    };
    std::vector<std::size_t> in_doubt;
    for (std::size_t k = 0; k < series.measures.size(); ++k)
        if (may_be_in(k))
            in_doubt.push_back(k);
    if (in_doubt.empty())
        return {};
    Method direct = series.method;
    scheme.algorithm = Algorithm::direct;
    direct.scheme = scheme;
    const RungResult other =
        run({runs.size() - 1, last.rung, series.final_time, direct, series.measures,
             [&](std::int64_t) { return execution.advance(0.0); }});
    double most = part;
    std::string words;
    for (const std::size_t k : in_doubt) {
        if (other.errors.empty())
            continue;
        const double error = series.measures[k].root_of(last.errors[k]);
        const double without = series.measures[k].root_of(other.errors[k]);
        if (const double share = std::abs(error - without) / error; share >= most) {
            most = share;
            words = fmt::format(
                "At s = {}, dt = {:.4g} the error {} is {:.2g}, and {:.2g} by the direct "
                "algorithm: the difference is what the fixed-point iteration leaves at this "
                "tolerance. It has no order in h and dt, and what is said of orders may be wrong "
                "by it; take a smaller tolerance, or algorithm = \"direct\".",
                last.rung.elements, last.rung.dt, series.measures[k].root(), error, without);
        }
    }
    return words;
}

} // namespace tvbeam
