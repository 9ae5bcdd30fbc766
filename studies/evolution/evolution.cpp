#include "studies/evolution/evolution.hpp"

#include "core/round_off.hpp"
#include "core/run.hpp"
#include "core/worse.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/scene/scene.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tvbeam {

namespace {

/// The sample with the value that `before` puts first, of those that are numbers; of those that
/// only round-off tells apart the earliest.
template <typename Before>
std::optional<std::size_t> extreme(const std::vector<double>& values, const Before& before) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isnan(values[i]) && (!best || before(values[i], values[*best])))
            best = i;
    constexpr double round_off = 1e-12;
    if (!best || std::isinf(values[*best]))
        return best;
    const auto first = std::find_if(values.begin(), values.end(), [&](double value) {
        return std::abs(value - values[*best]) <= round_off * std::abs(values[*best]);
    });
    return static_cast<std::size_t>(first - values.begin());
}

/// What the model gives at an end: (5), (10).
std::optional<double> given_value(const Beam& beam, const Probe& probe) {
    if (probe.x == 0.0 && probe.quantity == Probe::Quantity::temperature)
        return beam.theta_A;
    const bool at_other_end = probe.x == 1.0 && probe.quantity == Probe::Quantity::temperature;
    const bool clamped = probe.x == 0.0 && probe.quantity == Probe::Quantity::deflection;
    return at_other_end || clamped ? std::optional(0.0) : std::nullopt;
}

double exact_value(const Beam& beam, const ProblemData& data, const Probe& probe, double t) {
    if (const auto given = given_value(beam, probe))
        return *given;
    const ExactSolution& exact = *data.exact;
    if (probe.quantity != Probe::Quantity::stress) {
        const Field& field = probe.quantity == Probe::Quantity::deflection ? exact.u : exact.theta;
        return values(data, field, Eigen::ArrayXd::Constant(1, probe.x), t)(0);
    }
    if (!exact.stress)
        return 0.0;
    return data.amplitudes(Eigen::ArrayXd::Constant(1, t))(*exact.stress, 0);
}

std::vector<PeriodChange> changes_of(const std::vector<double>& t,
                                     const std::vector<ProbeHistory>& probes, std::size_t period) {
    std::vector<PeriodChange> periods;
    for (std::size_t end = 2 * period; end < t.size(); end += period) {
        PeriodChange change{t[end], {}};
        for (const auto& probe : probes) {
            double greatest = 0.0;
            for (std::size_t i = end - period + 1; i <= end; ++i)
                greatest = worse(greatest, std::abs(probe.values[i] - probe.values[i - period]));
            change.changes.push_back(greatest);
        }
        periods.push_back(std::move(change));
    }
    return periods;
}

/// Where the tip is at first, and its round-off, relative: the moment form's is a sum; the Hermite
/// form solves for it, so that it is taken from the data where they are known well enough.
std::pair<double, double> start_of(const Solver& solver, const Scheme& scheme,
                                   const ProblemData& data, std::int64_t elements) {
    const double of_sum = 1e-12;
    if (scheme.algorithm == Algorithm::direct)
        return {solver.tip_displacement(), of_sum};
    if (const auto tip = initial_tip(data))
        return {*tip, of_sum};
    return {solver.tip_displacement(), std::max(of_sum, hermite_solve_round_off(elements))};
}

} // namespace

std::optional<std::size_t> ProbeHistory::least() const {
    return extreme(values, [](double a, double b) { return a < b; });
}

std::optional<std::size_t> ProbeHistory::greatest() const {
    return extreme(values, [](double a, double b) { return a > b; });
}

std::optional<double> ProbeHistory::greatest_error() const {
    if (exact.empty())
        return std::nullopt;
    double greatest = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isnan(values[i]))
            greatest = worse(greatest, std::abs(values[i] - exact[i]));
    return greatest;
}

double ProbeHistory::mean() const {
    const auto undefined = [](double value) { return std::isnan(value); };
    const auto from = std::find_if_not(values.begin(), values.end(), undefined);
    return std::accumulate(from, values.end(), 0.0) /
           static_cast<double>(std::distance(from, values.end()));
}

std::map<std::string, double> EvolutionResult::figures() const {
    std::map<std::string, double> figures{{"beyond_stops", beyond_stops}};
    for (const auto& probe : probes) {
        if (const auto least = probe.least())
            figures[probe.name + ".least"] = probe.values[*least];
        if (const auto greatest = probe.greatest())
            figures[probe.name + ".greatest"] = probe.values[*greatest];
        if (!probe.values.empty()) {
            figures[probe.name + ".last"] = probe.values.back();
            if (!std::isnan(probe.values.front()))
                figures[probe.name + ".first"] = probe.values.front();
            figures[probe.name + ".mean"] = probe.mean();
        }
        if (const auto error = probe.greatest_error())
            figures[probe.name + ".error"] = *error;
    }
    figures["samples"] = static_cast<double>(t.size());
    for (std::size_t k = 0; k < probes.size() && !periods.empty(); ++k)
        figures[probes[k].name + ".period_change"] = periods.back().changes[k];
    if (!periods.empty())
        figures["period_change"] = std::accumulate(periods.back().changes.begin(),
                                                   periods.back().changes.end(), 0.0, worse);
    const bool ended = run.status == RungStatus::ok;
    int onsets = 0;
    int releases = 0;
    for (const auto& event : events) {
        if (!ended)
            break;
        const bool is_onset = event.kind == ContactEvent::Kind::onset;
        const std::string which = std::to_string(++(is_onset ? onsets : releases));
        figures[(is_onset ? "onset." : "release.") + which] = event.t;
        figures["beyond." + which] = event.beyond; // of a contact that has ended, its release's
    }
    figures["onsets"] = onsets;
    figures["releases"] = releases;
    if (!ended) // of a part of the time
        for (auto& [name, figure] : figures)
            figure = std::numeric_limits<double>::quiet_NaN();
    return figures;
}

Needs needs_of(const EvolutionBlock& block, const Stops& stops) {
    return needs_of(block.quantities()).with({false, stops.exist(), false});
}

EvolutionResult run_evolution(const Scene& scene, const EvolutionBlock& block,
                              const ProblemData& data, const Execution& execution) {
    EvolutionResult result;
    for (const auto& probe : block.probes)
        result.probes.push_back({probe.name, {}, {}});
    const Mesh mesh = scene.mesh.with(block.rung.elements);
    const ProbeReader reader(scene.beam, mesh, scene.scheme.thermal_mass, block.quantities());
    std::optional<ContactEvents> contact;
    std::int64_t step = 0;
    Observer observer;
    observer.needs = needs_of(block, scene.beam.stops);
    observer.visit = [&](double t, const Solver& solver) {
        if (scene.beam.stops.exist()) {
            if (contact) {
                contact->add(t, solver.tip_displacement(), solver.contact_stress());
            } else {
                const auto [tip, round_off] =
                    start_of(solver, scene.scheme, data, block.rung.elements);
                contact.emplace(scene.beam.stops, tip, round_off);
            }
        }
        if (step++ % block.every != 0)
            return;
        const Eigen::VectorXd values = reader.read(solver, t);
        result.t.push_back(t);
        for (std::size_t k = 0; k < block.probes.size(); ++k) {
            result.probes[k].values.push_back(values(static_cast<Eigen::Index>(k)));
            if (data.exact && block.probes[k].probe.quantity != Probe::Quantity::energy)
                result.probes[k].exact.push_back(
                    exact_value(scene.beam, data, block.probes[k].probe, t));
        }
    };
    const auto start = std::chrono::steady_clock::now();
    const RunResult run = tvbeam::run({scene.beam,
                                       mesh,
                                       scene.scheme,
                                       block.final_time,
                                       block.rung.steps,
                                       {},
                                       execution.steps_of(method_of(scene.scheme), block.rung)},
                                      data, &observer);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result.run = rung_result(block.rung, run, elapsed.count());
    if (contact) {
        result.events = contact->events();
        result.beyond_stops = contact->beyond_stops();
    }
    if (block.period)
        result.periods = changes_of(result.t, result.probes,
                                    static_cast<std::size_t>(*block.period / block.every));
    return result;
}

} // namespace tvbeam
