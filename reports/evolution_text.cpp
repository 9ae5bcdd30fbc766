#include "reports/evolution_text.hpp"

#include "reports/number_text.hpp"
#include "reports/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// Events shown of a long history: the first and the last ones.
constexpr std::size_t shown_events = 12;

std::string value_text(double value) {
    return value == 0.0 ? "0" : scientific(value, 4);
}

std::string time_text(double t) {
    return fixed(t, 4);
}

std::string probe_table(const EvolutionResult& result) {
    TextTable::Group key{"", {{"probe", {}}}};
    TextTable::Group range{"", {{"least", {}}, {"at t", {}}, {"greatest", {}}, {"at t", {}}}};
    TextTable::Group end{"", {{"at the end", {}}}};
    TextTable::Group error{"", {{"error", {}}}};
    for (const auto& probe : result.probes) {
        key.columns[0].cells.push_back(probe.name);
        const auto add = [&](std::size_t column, std::optional<std::size_t> sample) {
            range.columns[column].cells.push_back(sample ? value_text(probe.values[*sample]) : "");
            range.columns[column + 1].cells.push_back(sample ? time_text(result.t[*sample]) : "");
        };
        add(0, probe.least());
        add(2, probe.greatest());
        const bool defined = !probe.values.empty() && !std::isnan(probe.values.back());
        end.columns[0].cells.push_back(defined ? value_text(probe.values.back()) : "");
        error.columns[0].cells.push_back(scientific(probe.greatest_error(), 2));
    }
    std::vector<TextTable::Group> groups{range, end};
    const bool exact = std::any_of(result.probes.begin(), result.probes.end(),
                                   [](const ProbeHistory& probe) { return !probe.exact.empty(); });
    if (exact)
        groups.push_back(error);
    return TextTable(key, groups).text() +
           (exact ? "error: greatest distance from the exact solution\n" : "");
}

std::string contact_text(const EvolutionResult& result, const Stops& stops) {
    std::string text;
    const auto& events = result.events;
    if (events.empty()) {
        text += "The tip never presses on a stop.\n";
    } else {
        TextTable::Group table{"", {{"t", {}}, {"contact", {}}, {"stop", {}}}};
        for (std::size_t i = 0; i < events.size(); ++i) {
            if (events.size() > shown_events && i >= shown_events / 2 &&
                i < events.size() - shown_events / 2)
                continue;
            table.columns[0].cells.push_back(time_text(events[i].t));
            table.columns[1].cells.push_back(name_of(events[i].kind));
            table.columns[2].cells.push_back(name_of(events[i].stop));
        }
        text += TextTable(table, {}).text();
        if (events.size() > shown_events)
            text += fmt::format("of {} events the first and the last {}\n", events.size(),
                                shown_events / 2);
    }
    if (stops.epsilon == 0.0)
        text += wrapped(result.beyond_stops > 0.0
                            ? "The tip passes a stop by " + scientific(result.beyond_stops, 1) +
                                  " at most: round-off of the sum that makes it."
                            : "The tip never passes a stop, to the last digit.");
    return text;
}

std::string period_table(const EvolutionResult& result) {
    TextTable::Group key{"", {{"period to t", {}}}};
    TextTable::Group changes{"greatest change from the period before", {}};
    for (const auto& probe : result.probes)
        changes.columns.push_back({probe.name, {}});
    for (const auto& period : result.periods) {
        key.columns[0].cells.push_back(shortest(period.end));
        for (std::size_t k = 0; k < period.changes.size(); ++k)
            changes.columns[k].cells.push_back(scientific(period.changes[k], 1));
    }
    return TextTable(key, {changes}).text();
}

} // namespace

std::string evolution_text(const EvolutionResult& result, const Scene& scene) {
    const EvolutionBlock& block = *scene.evolution;
    std::string text =
        wrapped(fmt::format("Evolution up to T = {} with s = {}, dt = {}, {} samples",
                            shortest(block.final_time), block.rung.elements,
                            shortest(block.rung.dt), result.t.size())) +
        "\n";
    if (result.run.status != RunStatus::ok)
        text += wrapped("The run failed, and this is what it reached: " + result.run.reason) + "\n";
    text += probe_table(result);
    if (scene.beam.stops.exist())
        text += "\n" + contact_text(result, scene.beam.stops);
    if (!result.periods.empty())
        text += "\n" + period_table(result);
    return text;
}

std::string evolution_csv(const EvolutionResult& result) {
    std::string text = "t";
    for (const auto& probe : result.probes)
        text += "," + probe.name + (probe.exact.empty() ? "" : "," + probe.name + "_exact");
    text += "\n";
    const auto field = [](double value) {
        return std::isnan(value) ? std::string(",") : fmt::format(",{}", value);
    };
    for (std::size_t i = 0; i < result.t.size(); ++i) {
        text += fmt::format("{}", result.t[i]);
        for (const auto& probe : result.probes) {
            text += field(probe.values[i]);
            if (!probe.exact.empty())
                text += field(probe.exact[i]);
        }
        text += "\n";
    }
    return text;
}

std::string name_of(ContactEvent::Kind kind) {
    return kind == ContactEvent::Kind::onset ? "onset" : "release";
}

std::string name_of(ContactEvent::Stop stop) {
    return stop == ContactEvent::Stop::lower ? "g1" : "g2";
}

} // namespace tvbeam
