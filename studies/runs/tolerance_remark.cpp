#include "studies/runs/tolerance_remark.hpp"

#include "core/contraction.hpp"
#include "studies/runs/beam_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tvbeam {

namespace {

constexpr double part = 0.1; ///< of an error, from which on something else is said to be in it

/// What the iteration may leave in the unknowns.
double bound_of(const Scene& scene, const Scheme& scheme, double final_time, const Rung& rung) {
    const Mesh mesh = scene.mesh.with(rung.elements);
    double rho = greatest_contraction(scene.beam, mesh, scheme, rung.dt);
    if (!(rho < 1.0)) // the run came to its end, as a stop held the tip
        rho = greatest_contraction(scene.beam, mesh, scheme, rung.dt, Tip::held);
    const double adding_up = std::max(1.0, std::min(final_time, 1.0) / rung.dt);
    return adding_up * scheme.tolerance * rho / (1.0 - rho);
}

/// The measure of which the run's error changes most from one run to another, by a part of it or
/// more.
std::optional<std::size_t> most_changed(const Series& series, const RungResult& run,
                                        const RungResult& from, const RungResult& to) {
    std::optional<std::size_t> found;
    double most = part;
    for (std::size_t k = 0; k < series.measures.size(); ++k) {
        const auto error = [&](const RungResult& of) {
            return series.measures[k].root_of(of.errors[k]);
        };
        const double share = std::abs(error(from) - error(to)) / error(run);
        if (error(run) > 0.0 && share >= most) {
            most = share;
            found = k;
        }
    }
    return found;
}

} // namespace

std::string tolerance_remark(const Scene& scene, const Series& series,
                             const std::vector<RungResult>& runs, const RunCall& run,
                             const Execution& execution) {
    const Scheme own = scheme_of(series.method);
    if (own.algorithm != Algorithm::fixed_point || runs.empty() || runs.back().errors.empty())
        return {};
    const RungResult& last = runs.back();
    const double bound = bound_of(scene, own, series.final_time, last.rung);
    const auto error_of = [&](const RungResult& of, std::size_t k) {
        return series.measures[k].root_of(of.errors[k]);
    };
    bool may_be_in = false;
    for (std::size_t k = 0; k < series.measures.size(); ++k)
        may_be_in = may_be_in || (error_of(last, k) > 0.0 && bound >= part * error_of(last, k));
    if (!may_be_in)
        return {};
    const auto once_more = [&](const Scheme& scheme) {
        Method method = series.method;
        method.scheme = scheme;
        return run({runs.size() - 1, last.rung, series.final_time, method, series.measures,
                    [&](std::int64_t) { return execution.advance(0.0); }});
    };
    Scheme scheme = own;
    scheme.algorithm = Algorithm::direct;
    const RungResult direct = once_more(scheme);
    if (direct.errors.empty() || !most_changed(series, last, last, direct))
        return {};
    // The Hermite form has round-off, too, which a tolerance at which the iteration leaves nothing
    // to be seen leaves as it is.
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < series.measures.size(); ++k)
        if (error_of(last, k) > 0.0)
            least = std::min(least, error_of(last, k));
    constexpr double unseen = 0.01; // of an error
    scheme = own;
    scheme.tolerance *= std::min(unseen, unseen * least / bound);
    const RungResult closer = once_more(scheme);
    const auto found = [&](std::size_t k, const RungResult& other) {
        return fmt::format("At s = {}, dt = {:.4g} the error {} is {:.2g}, and {:.2g} ",
                           last.rung.elements, last.rung.dt, series.measures[k].root(),
                           error_of(last, k), error_of(other, k));
    };
    if (closer.errors.empty()) // it does not come so close
        return found(*most_changed(series, last, last, direct), direct) +
               "by the direct algorithm: the difference is what the fixed-point iteration leaves "
               "at this tolerance, or the round-off of the Hermite form. It has no order in h and "
               "dt, and what is said of orders may be wrong by it; take algorithm = \"direct\".";
    std::string words;
    if (const auto k = most_changed(series, last, last, closer))
        words = found(*k, closer) +
                fmt::format("with the tolerance {:.2g}: the difference is what the fixed-point "
                            "iteration leaves at {:.2g}. It has no order in h and dt, and what is "
                            "said of orders may be wrong by it; take a smaller tolerance, or "
                            "algorithm = \"direct\".",
                            scheme.tolerance, own.tolerance);
    if (const auto k = most_changed(series, last, closer, direct))
        words += (words.empty() ? "" : " ") + found(*k, direct) +
                 fmt::format("by the direct algorithm: {} round-off of the Hermite form, which no "
                             "tolerance makes smaller.",
                             words.empty() ? "the difference is" : "a part of it is");
    return words;
}

} // namespace tvbeam
