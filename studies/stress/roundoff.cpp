#include "studies/stress/roundoff.hpp"

#include "core/round_off.hpp"
#include "core/run.hpp"
#include "core/time/time_levels.hpp"
#include "core/worse.hpp"
#include "studies/stress/mode_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace tvbeam {

namespace {

/// θ = sin πx, at rest; the exact solution to measure against is zero.
ProblemData mode_problem() {
    ProblemData data;
    data.theta_initial.rest = [](const Eigen::ArrayXd& x, double) -> Eigen::ArrayXd {
        return (std::numbers::pi * x).sin();
    };
    data.exact = ExactSolution{};
    return data;
}

Scheme scheme_of(const RoundOffBlock& block, Algorithm algorithm) {
    Scheme scheme;
    scheme.algorithm = algorithm;
    scheme.thermal_mass = block.thermal_mass;
    scheme.time = TimeScheme::named(block.time);
    scheme.basis = Basis::nodal;
    scheme.tolerance = 1e-14;
    return scheme;
}

double largest(const std::vector<Mode>& modes, long double Mode::*field, std::size_t first) {
    long double most = 0.0L;
    for (std::size_t n = first; n < modes.size(); ++n)
        most = std::max(most, std::abs(modes[n].*field));
    return static_cast<double>(most);
}

Floor nodal_floor(const RoundOffBlock& block, const Beam& beam, const Mesh& mesh,
                  Algorithm algorithm, const std::vector<Mode>& modes) {
    const ProblemData data = mode_problem();
    const Scheme scheme = scheme_of(block, algorithm);
    try {
        const auto solver =
            make_solver(beam, data, mesh, scheme, block.dt, Needs{true, true, true});
        const Eigen::ArrayXd sine = (std::numbers::pi * mesh.nodes).sin();
        const double theta = largest(modes, &Mode::theta, 0);
        const double w = largest(modes, &Mode::w, 1);
        TimeLevels levels(data, scheme.time, block.dt * static_cast<double>(block.steps),
                          block.steps);
        double worst = 0.0;
        for (std::int64_t n = 1; n <= block.steps; ++n) {
            if (std::string reason = solver->step(levels.at(n)); !reason.empty())
                return {std::nullopt, reason + " in step " + std::to_string(n)};
            const Mode& mode = modes[static_cast<std::size_t>(n)];
            const Eigen::ArrayXd temperature = solver->temperature();
            const DiscontinuousLinear curvature = solver->curvature();
            const Eigen::Index s = mesh.elements();
            worst = std::max(
                {worst,
                 (temperature - static_cast<double>(mode.theta) * sine).abs().maxCoeff() / theta,
                 (curvature.row(0).transpose() - static_cast<double>(mode.w) * sine.head(s))
                         .abs()
                         .maxCoeff() /
                     w});
        }
        return {worst, {}};
    } catch (const std::domain_error& error) {
        return {std::nullopt, error.what()};
    }
}

/// The norms of a run in the sine basis against those of the mode.
std::optional<double> sine_floor(const RoundOffBlock& block, const Beam& beam, const Mesh& mesh,
                                 const std::vector<Mode>& modes) {
    if (mesh.elements() < 2) // has no such mode
        return std::nullopt;
    const ProblemData data = mode_problem();
    Scheme scheme = scheme_of(block, Algorithm::direct);
    scheme.basis = Basis::automatic;
    const std::vector<Norm> norms{*Norm::named("theta_L2L2_sq"), *Norm::named("u_LinfH2semi")};
    const RunResult result =
        run({beam, mesh, scheme, block.dt * static_cast<double>(block.steps), block.steps, norms},
            data);
    if (result.status != RunStatus::ok || result.counters.sine_steps == 0)
        return std::nullopt;
    const double sine = std::sin(std::numbers::pi / 2.0 / static_cast<double>(mesh.elements()));
    const double square = (3.0 - 2.0 * sine * sine) / 6.0; // ‖I_h sin πx‖²
    double sum = 0.0;
    for (std::size_t n = 1; n < modes.size(); ++n)
        sum += block.dt * static_cast<double>(modes[n].theta * modes[n].theta) * square;
    const double w = largest(modes, &Mode::w, 1) * std::sqrt(square);
    constexpr double has_square = 1e-140; // in doubles, of which a norm sums squares
    if (w < has_square)
        return std::nullopt;
    return std::max(std::abs(result.errors[0] - sum) / sum, std::abs(result.errors[1] - w) / w);
}

} // namespace

RoundOffRow measure_round_off(const RoundOffBlock& block, std::size_t index) {
    const std::int64_t elements = block.elements[index];
    const Beam beam{.alpha = block.alpha, .zeta = block.zeta};
    const Mesh mesh = Mesh::uniform(elements);
    const auto modes = discrete_mode(beam, block.thermal_mass, block.time, elements, {1.0L, 0.0L},
                                     false, block.dt, block.steps);
    RoundOffRow row;
    row.elements = elements;
    row.moment = nodal_floor(block, beam, mesh, Algorithm::direct, modes);
    row.sine = sine_floor(block, beam, mesh, modes);
    if (elements <= block.finest_hermite)
        row.hermite = nodal_floor(block, beam, mesh, Algorithm::fixed_point, modes);
    row.hermite_predicted = hermite_floor(elements, block.zeta, block.dt, block.steps);
    const auto exact = exact_mode(beam, {1.0L, 0.0L}, block.dt, block.steps);
    long double error = 0.0L;
    for (std::size_t n = 1; n < modes.size(); ++n)
        error = std::max(error, std::abs(modes[n].w - exact[n].w));
    row.discretisation_error = static_cast<double>(error) / largest(exact, &Mode::w, 1);
    if (row.hermite_predicted > row.discretisation_error)
        row.remark = "the Hermite form's predicted round-off exceeds the discretisation error";
    return row;
}

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Of the rows that were run; a NaN for one that stopped, which the extremes of PropagateNaN keep.
Eigen::ArrayXd hermite_ratios(const std::vector<RoundOffRow>& rows) {
    std::vector<double> ratios;
    for (const auto& row : rows)
        if (row.hermite.value || !row.hermite.reason.empty())
            ratios.push_back(row.hermite.value.value_or(unknown) / row.hermite_predicted);
    return Eigen::Map<const Eigen::ArrayXd>(ratios.data(),
                                            static_cast<Eigen::Index>(ratios.size()));
}

} // namespace

double RoundOffTable::greatest_moment_floor() const {
    double greatest = 0.0;
    for (const auto& row : rows) {
        if (!row.moment.value)
            return unknown;
        greatest = std::max({greatest, *row.moment.value, row.sine.value_or(0.0)});
    }
    return greatest;
}

double RoundOffTable::least_hermite_ratio() const {
    const Eigen::ArrayXd ratios = hermite_ratios(rows);
    return ratios.size() == 0 ? unknown : ratios.minCoeff<Eigen::PropagateNaN>();
}

double RoundOffTable::greatest_hermite_ratio() const {
    const Eigen::ArrayXd ratios = hermite_ratios(rows);
    return ratios.size() == 0 ? unknown : ratios.maxCoeff<Eigen::PropagateNaN>();
}

double RoundOffTable::greatest_discretisation_error() const {
    double greatest = 0.0;
    for (const auto& row : rows)
        greatest = worse(greatest, row.discretisation_error);
    return greatest;
}

std::size_t RoundOffTable::remarks() const {
    return static_cast<std::size_t>(std::count_if(
        rows.begin(), rows.end(), [](const auto& row) { return !row.remark.empty(); }));
}

} // namespace tvbeam
