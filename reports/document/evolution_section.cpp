#include "reports/document/evolution_section.hpp"

#include "studies/text/number_text.hpp"

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

/// The times of an evolution, with as many digits as tell its steps apart.
struct TimeScale {
    double final_time, dt;

    [[nodiscard]] std::string text(double t) const {
        const double decade = std::floor(std::log10(final_time));
        constexpr double most = 6; // of zeros, on either side of the point
        if (std::abs(decade) > most)
            return scientific(
                t, static_cast<int>(std::clamp(std::ceil(std::log10(final_time / dt)), 4.0, 16.0)));
        return fixed(
            t, static_cast<int>(std::max(4 + std::max(0.0, -decade), std::ceil(-std::log10(dt)))));
    }
};

bool has_exact(const EvolutionResult& result) {
    return std::any_of(result.probes.begin(), result.probes.end(),
                       [](const ProbeHistory& probe) { return !probe.exact.empty(); });
}

Table probe_table(const EvolutionResult& result, const TimeScale& times) {
    Table::Group key{"", {{"probe", {}}}};
    Table::Group range{"", {{"least", {}}, {"at t", {}}, {"greatest", {}}, {"at t", {}}}};
    Table::Group end{"", {{"at the end", {}}}};
    Table::Group error{"", {{"error", {}}}};
    for (const auto& probe : result.probes) {
        key.columns[0].cells.push_back(probe.name);
        const auto add = [&](std::size_t column, std::optional<std::size_t> sample) {
            range.columns[column].cells.push_back(sample ? value_text(probe.values[*sample]) : "");
            range.columns[column + 1].cells.push_back(sample ? times.text(result.t[*sample]) : "");
        };
        add(0, probe.least());
        add(2, probe.greatest());
        const bool defined = !probe.values.empty() && !std::isnan(probe.values.back());
        end.columns[0].cells.push_back(defined ? value_text(probe.values.back()) : "");
        error.columns[0].cells.push_back(scientific(probe.greatest_error(), 2));
    }
    std::vector<Table::Group> groups{range, end};
    if (has_exact(result))
        groups.push_back(error);
    return {"What the probes range over.", key, groups};
}

Table event_table(const std::vector<ContactEvent>& events, const TimeScale& times, bool yields) {
    Table::Group key{"", {{"t", {}}}};
    Table::Group what{"", {{"contact", {}}, {"stop", {}}}};
    if (yields)
        what.columns.push_back({"beyond", {}});
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (events.size() > shown_events && i >= shown_events / 2 &&
            i < events.size() - shown_events / 2)
            continue;
        key.columns[0].cells.push_back(times.text(events[i].t));
        what.columns[0].cells.push_back(name_of(events[i].kind));
        what.columns[1].cells.push_back(name_of(events[i].stop));
        if (yields)
            what.columns[2].cells.push_back(scientific(events[i].beyond, 2));
    }
    return {std::string("The tip meets a stop (onset) and leaves it (release)") +
                (yields ? "; beyond: how far it passes the stop in that contact." : "."),
            key,
            {what}};
}

/// What never happened is said of a whole run only.
void add_contact(Section& section, const EvolutionResult& result, const TimeScale& times,
                 const Stops& stops) {
    const bool whole = result.run.status == RungStatus::ok;
    if (!whole && result.events.empty())
        return;
    section.blocks.emplace_back(BlankLine{});
    if (result.presses_within_steps())
        section.blocks.emplace_back(
            Finding{"The tip presses on a stop within steps alone, at the end of none: smaller "
                    "steps show when."});
    else if (result.events.empty())
        section.blocks.emplace_back(Finding{"The tip never presses on a stop."});
    else
        section.blocks.emplace_back(event_table(result.events, times, stops.epsilon > 0.0));
    if (result.events.size() > shown_events)
        section.blocks.emplace_back(Paragraph{fmt::format("of {} events the first and the last {}",
                                                          result.events.size(), shown_events / 2)});
    if (whole && !result.presses_within_steps())
        section.blocks.emplace_back(
            Finding{result.beyond_stops > 0.0
                        ? "The tip penetrates a stop by " + rounded_up(result.beyond_stops, 1) +
                              " at most" + (stops.epsilon > 0.0 ? ": the stops yield." : ".")
                        : "The tip never penetrates a stop."});
}

Table period_table(const EvolutionResult& result) {
    Table::Group key{"", {{"period to t", {}}}};
    std::vector<Table::Group> changes; // of one column each: a wide table breaks between groups
    for (const auto& probe : result.probes)
        changes.push_back({"", {{probe.name, {}}}});
    for (const auto& period : result.periods) {
        key.columns[0].cells.push_back(shortest(period.end));
        for (std::size_t k = 0; k < period.changes.size(); ++k)
            changes[k].columns[0].cells.push_back(scientific(period.changes[k], 1));
    }
    return {"The largest change of each probe since the previous period.", key, changes};
}

} // namespace

Section evolution_section(const EvolutionResult& result, const Scene& scene) {
    const EvolutionBlock& block = *scene.get<EvolutionBlock>();
    const TimeScale times{block.final_time, block.rung.dt};
    Section section{"Evolution", {}};
    section.blocks.emplace_back(Paragraph{fmt::format(
        "Evolution up to T = {} with s = {}, dt = {}, {} samples{}", shortest(block.final_time),
        block.rung.elements, shortest(block.rung.dt), result.t.size(),
        block.every > 1
            ? fmt::format(", one every {} steps, which all figures of probes are of", block.every)
            : "")});
    section.blocks.emplace_back(BlankLine{});
    if (result.run.status != RungStatus::ok)
        section.blocks.emplace_back(
            Finding{std::string(result.run.status == RungStatus::failed ? "The run failed"
                                                                        : "The run did not end") +
                    "; this is what it reached: " + result.run.reason});
    section.blocks.emplace_back(probe_table(result, times));
    if (has_exact(result))
        section.blocks.emplace_back(Paragraph{"error: greatest distance from the exact solution"});
    if (scene.beam.stops.exist())
        add_contact(section, result, times, scene.beam.stops);
    if (!result.periods.empty()) {
        section.blocks.emplace_back(BlankLine{});
        section.blocks.emplace_back(
            Paragraph{"largest change since the previous period, by period and probe:", 2, true});
        section.blocks.emplace_back(period_table(result));
        const auto& last = result.periods.back().changes;
        section.blocks.emplace_back(Finding{fmt::format(
            "From the last period but one to the last, no probe changes by more than {}.",
            rounded_up(*std::max_element(last.begin(), last.end()), 1))});
    }
    return section;
}

} // namespace tvbeam
