#include "studies/runs/round_off_remark.hpp"

#include "core/norms/norm_sums.hpp"
#include "core/norms/norms.hpp"
#include "core/round_off.hpp"
#include "core/space/linear_elements.hpp"
#include "core/worse.hpp"
#include "mms/forecast/expected_orders.hpp"
#include "mms/text/input_error.hpp"
#include "studies/reference/reference_solution.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tvbeam {

namespace {

/// Of the norm of the solution: no discretisation error is told from rounding below it.
constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

/// Of values at the nodes, in L²; of what is so large, or so small, that doubles have no square of
/// it, too.
double norm_of(const Mesh& mesh, const Eigen::ArrayXd& values) {
    const double largest = values.abs().maxCoeff();
    return largest > 0.0 && std::isfinite(largest)
               ? largest * std::sqrt(squared_norm(mesh, (values / largest).matrix()))
               : largest;
}

/// Times of the series; a computed solution is known at those of its runs.
std::vector<double> times_of(const ProblemData& data, const Series& series) {
    constexpr std::int64_t most = 16;
    const bool is_computed = data.exact->elements > 0;
    std::int64_t steps = most;
    if (is_computed)
        steps = std::ranges::min_element(series.rungs, {}, &Rung::steps)->steps;
    const std::int64_t count = std::min(steps, most);
    std::vector<double> times;
    for (std::int64_t n = is_computed ? 1 : 0; n <= count; ++n) {
        const std::int64_t level = n * steps / count; // rounded down
        times.push_back(series.final_time * static_cast<double>(level) /
                        static_cast<double>(steps));
    }
    return times;
}

/// The norm of the exact solution, that of its contact stress apart, from its greatest values over
/// some times.
double size_of_exact(const ProblemData& data, const Norm& norm, const Series& series) {
    const Mesh mesh = Mesh::uniform(16);
    const auto fields = data.exact->fields();
    double sum = 0.0;
    for (const TimeNorm& part : norm.parts) {
        double greatest = 0.0;
        for (const double t : times_of(data, series)) {
            double size = 0.0;
            for (std::size_t k = 0; k < fields.size(); ++k)
                if (part.quantities[k])
                    size = std::hypot(size, norm_of(mesh, values(data, *fields[k], mesh.nodes, t)));
            greatest = std::max(greatest, size);
        }
        sum = std::hypot(sum, part.kind == TimeNorm::Kind::L2
                                  ? std::sqrt(series.final_time) * greatest
                                  : greatest);
    }
    return sum;
}

/// The greatest of a field over some times, in the norm of L².
double greatest_of(const ProblemData& data, const Field& field, const Series& series) {
    const Mesh mesh = Mesh::uniform(16);
    double greatest = 0.0;
    for (const double t : times_of(data, series))
        greatest = std::max(greatest, norm_of(mesh, values(data, field, mesh.nodes, t)));
    return greatest;
}

/// The greatest contact stress over some times.
double greatest_stress(const ProblemData& data, const Series& series) {
    if (!data.exact->stress)
        return 0.0;
    const std::vector<double> times = times_of(data, series);
    const Eigen::Map<const Eigen::ArrayXd> all(times.data(),
                                               static_cast<Eigen::Index>(times.size()));
    return data.amplitudes(all).row(*data.exact->stress).abs().maxCoeff();
}

/// What rounding is measured by: the exact solution, and what is as large beside it that it comes
/// from; where all of that is zero, the sources.
struct Scale {
    double size;
    std::string words;
};

Scale scale_of(const Beam& beam, const ProblemData& data, const Norm& norm, const Series& series) {
    const QuantitySet measured = quantities_of({norm});
    const auto has = [&](tvbeam::Quantity quantity) { return measured[index(quantity)]; };
    const bool sums_up = std::ranges::any_of(
        norm.parts, [](const TimeNorm& part) { return part.kind == TimeNorm::Kind::L2; });
    const double duration = sums_up ? std::max(1.0, std::sqrt(series.final_time)) : 1.0;
    const bool is_of_heat = has(tvbeam::Quantity::theta) || has(tvbeam::Quantity::theta_x);
    const double stress = duration * greatest_stress(data, series);
    const double own = has(tvbeam::Quantity::stress)
                           ? std::hypot(size_of_exact(data, norm, series), stress)
                           : size_of_exact(data, norm, series);
    double size = own;
    if (has(tvbeam::Quantity::stress) || !is_of_heat)
        size = std::max({size, stress, duration * greatest_of(data, data.moment_load, series)});
    if (has(tvbeam::Quantity::stress))
        size = std::max(size, duration * greatest_of(data, data.exact->u_xx, series));
    if (is_of_heat)
        size = std::max(size, std::abs(beam.alpha) * duration *
                                  greatest_of(data, data.exact->u_xx, series));
    else
        size = std::max(size, std::abs(beam.alpha) * duration *
                                  greatest_of(data, data.exact->theta, series));
    if (size > own)
        return {size, fmt::format("of {:.2g}, which comes from terms of {:.2g}", own, size)};
    if (size > 0.0)
        return {size, fmt::format("of {:.2g}", size)};
    const double sources = std::max(greatest_of(data, data.heat_source, series),
                                    greatest_of(data, data.moment_load, series));
    return {sources, fmt::format("of a solution of 0 with sources of {:.2g}", sources)};
}

/// What rounding may be of an error on the rung. It grows with what it is summed up over; a stress
/// answers to rates.
double rounding_on(const Rung& rung, const Beam& beam, const Norm& norm, double size) {
    constexpr double elements_of_it = 16.0;
    constexpr double steps_of_it = 8.0;
    const bool is_of_stress = quantities_of({norm})[index(tvbeam::Quantity::stress)];
    const auto elements = static_cast<double>(rung.elements);
    const double steps = is_of_stress ? remembered_steps(beam.zeta, rung.dt, rung.steps) : 1.0;
    return round_off * size *
           std::max(std::max(1.0, elements / elements_of_it), steps / steps_of_it);
}

/// The same of the scene's reference, each of its runs with its weight.
double rounding_of_reference(const Scene& scene, const Series& series, const Norm& norm,
                             double size) {
    const double dt = scene.reference->dt;
    return extrapolation_of(scene).weights() *
           rounding_on({scene.reference->elements, std::llround(series.final_time / dt), dt},
                       scene.beam, norm, size);
}

bool measures_deflection_alone(const Norm& norm) {
    const QuantitySet measured = quantities_of({norm});
    const auto has = [&](tvbeam::Quantity quantity) { return measured[index(quantity)]; };
    return !has(tvbeam::Quantity::theta) && !has(tvbeam::Quantity::theta_x) &&
           !has(tvbeam::Quantity::stress);
}

/// Whether theory has no error of that norm, neither in h nor in Δt; nothing: it does not say,
/// or the time levels decide.
std::optional<bool> exact_in_theory(const Scene& scene, const Series& series, const Norm& norm) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr)
        return std::nullopt;
    const std::string& scheme = scheme_of(series.method).time.name;
    try {
        const auto expected = expected_orders({*solution, scene.beam, series.final_time});
        for (const ExpectedOrder& row : expected.orders) {
            if (row.norm != norm.name)
                continue;
            const Forecast& in_dt = row.in_dt(scheme);
            const bool has_time_error = in_dt.is_known() && !in_dt.none_at_levels;
            const bool stalls = expected.law_distance > 0.0 && row.in_h.has_error();
            if (row.in_h.is_known() || has_time_error || stalls)
                return false;
            if (!row.in_h.has_error() && !in_dt.has_error())
                return true;
        }
    } catch (const InputError&) {
        // A final time, or a place of the formulas, that theory says nothing of.
    }
    return std::nullopt;
}

} // namespace

std::string round_off_remark(const Beam& beam, const ProblemData& data, const Series& series,
                             const std::vector<RungResult>& rungs, std::size_t k) {
    const Measure& measure = series.measures[k];
    const Scheme& scheme = scheme_of(series.method);
    const auto norm = Norm::named(measure.root());
    if (scheme.algorithm != Algorithm::fixed_point || !data.exact || !norm ||
        !measures_deflection_alone(*norm))
        return {};
    const double size = size_of_exact(data, *norm, series);
    for (const auto& rung : rungs) {
        if (rung.errors.empty())
            continue;
        const double error = measure.root_of(rung.errors[k]);
        const double most = size * hermite_round_off(scheme.time.name, rung.rung.elements,
                                                     beam.zeta, rung.rung.dt, rung.rung.steps);
        if (most <= error / 2.0)
            continue;
        return fmt::format(
            "{}: from s = {} on, the round-off of the Hermite form, which grows like h^-4, may "
            "exceed the discretisation error: up to {:.2g} is predicted of an error of {:.2g}; "
            "algorithm = \"direct\" does not suffer it",
            measure.name, rung.rung.elements, most, error);
    }
    return {};
}

std::optional<RoundingErrors> rounding_errors(const Scene& scene, const ProblemData& data,
                                              const Series& series,
                                              const std::vector<RungResult>& runs,
                                              const std::vector<RungResult>& refined,
                                              std::size_t k) {
    const Measure& measure = series.measures[k];
    const auto norm = Norm::named(measure.root());
    if (!data.exact || !norm)
        return std::nullopt;
    const Scale scale = scale_of(scene.beam, data, *norm, series);
    double greatest = 0.0;
    double most = 0.0;
    bool is_below = true;
    const double of_reference =
        data.exact->elements > 0 ? rounding_of_reference(scene, series, *norm, scale.size) : 0.0;
    for (const auto& run : runs)
        if (!run.errors.empty()) {
            const double error = measure.root_of(run.errors[k]);
            const double below =
                rounding_on(run.rung, scene.beam, *norm, scale.size) + of_reference;
            is_below = is_below && error <= below;
            greatest = worse(greatest, error);
            most = std::max(most, below);
        }
    // Beside a scale beyond the range of doubles everything would be small.
    if (!(greatest > 0.0 && is_below && std::isfinite(scale.size)))
        return std::nullopt;
    const auto said = [&](const std::string& what, const std::string& follows, bool is_certain) {
        return RoundingErrors{
            measure.squared ? most * most : most,
            fmt::format("{}, {:.2g} at most {}{}", what, greatest, scale.words, follows),
            is_certain ? "its error is rounding" : "its error may be rounding"};
    };
    const auto is_exact = exact_in_theory(scene, series, *norm);
    if (is_exact && *is_exact)
        return said("every error is rounding",
                    ": the scheme is exact for the solution, which tests nothing of its order",
                    true);
    // What converges is no rounding, however small: of an end temperature of 1e10 the rest is.
    std::vector<double> errors;
    for (const auto& run : refined)
        if (!run.errors.empty())
            errors.push_back(measure.root_of(run.errors[k]));
    constexpr double falls = 0.8;
    const bool may_converge = std::ranges::adjacent_find(errors, [&](double coarse, double fine) {
                                  return !(fine <= falls * coarse);
                              }) == errors.end();
    constexpr std::size_t told = 3; // two fall by chance
    if (may_converge && errors.size() >= told)
        return std::nullopt;
    return said("no error is larger than rounding may be",
                is_exact ? ", though the scheme is not exact for the solution: an order that they "
                           "show may be that of rounding"
                : may_converge ? ": three levels that refine both h and dt would tell whether the "
                                 "scheme is exact for the solution"
                               : ", and they do not fall: as far as they show, the scheme is exact "
                                 "for the solution, which tests nothing of its order",
                false);
}

} // namespace tvbeam
