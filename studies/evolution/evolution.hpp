#pragma once

#include "core/contact/contact_events.hpp"
#include "core/problem.hpp"
#include "core/solver.hpp"
#include "studies/evolution/evolution_block.hpp"
#include "studies/runs/execution.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

struct Scene;

/// What one probe read, a value a sample. A value that is not defined, the stress at t = 0, is not
/// a number.
struct ProbeHistory {
    std::string name;
    std::vector<double> values;
    std::vector<double> exact; ///< of the exact solution; empty without one, and of the energy

    /// The samples with the least and the greatest value; none where no value is defined.
    [[nodiscard]] std::optional<std::size_t> least() const;
    [[nodiscard]] std::optional<std::size_t> greatest() const;
    /// Of the samples from the first one with a value on.
    [[nodiscard]] double mean() const;
    /// The greatest |value − exact|; not a number where an exact value is none.
    [[nodiscard]] std::optional<double> greatest_error() const;
};

/// How much a period differs from the one before it.
struct PeriodChange {
    double end = 0.0;            ///< the time at which the period ends
    std::vector<double> changes; ///< of every probe: the greatest |p(t) − p(t − period)| over it
};

/// The record of an [evolution] study. Of a run that failed, what it reached.
struct EvolutionResult {
    RungResult run;
    std::vector<double> t; ///< of the samples
    std::vector<ProbeHistory> probes;
    std::vector<ContactEvent> events;  ///< in time
    double beyond_stops = 0.0;         ///< ContactEvents::beyond_stops
    std::vector<PeriodChange> periods; ///< from the second one on

    /// The tip is on a stop in a stage of a step, and at no step's end.
    [[nodiscard]] bool presses_within_steps() const { return events.empty() && run.has_kink; }

    /// What [expect.evolution] may hold bands for: PROBE.least, .greatest, .first, .last,
    /// .mean, .error, .period_change (of the last period); samples (how many), beyond_stops,
    /// period_change (the greatest of all probes); onsets, releases (how many), onset.1,
    /// release.1, … (when), beyond.1, … (ContactEvent::beyond of each contact). Of a run that did
    /// not end they are no numbers, and those of events not there.
    [[nodiscard]] std::map<std::string, double> figures() const;
};

/// Runs the scene's scheme once, and looks at it in time.
EvolutionResult run_evolution(const Scene& scene, const EvolutionBlock& block,
                              const ProblemData& data, const Execution& execution = {});

/// What an evolution must solve for: what its probes read, and the tip where there are stops.
Needs needs_of(const EvolutionBlock& block, const Stops& stops);

} // namespace tvbeam
