#include "studies/ladder/ladder_block.hpp"

#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

namespace {

PublishedFigures read_printed(TableReader table, const LadderBlock& ladder, const Place& norms,
                              const SolverKeys& keys) {
    PublishedFigures printed;
    for (const auto& measure : ladder.norms)
        if (!table.is_string(measure.name))
            table.require_free(measure.name);
    printed.source = table.text("source").value_or("published");
    printed.figures = read_by_measure(
        table, keys, ladder.norms, norms,
        [&](const std::string& name, const std::vector<double>& list) {
            if (list.size() != ladder.rungs.size())
                throw table.error(name, " has " + std::to_string(list.size()) +
                                            (list.size() == 1 ? " value for " : " values for ") +
                                            std::to_string(ladder.rungs.size()) +
                                            " levels; give one a level, or none: --set " +
                                            table.full("") + "={}");
        });
    return printed;
}

/// Levels that `until` adds are not those of a list.
void read_refining(TableReader& table, LadderBlock& ladder) {
    const std::optional<SourceText> formula =
        table.is_string("dt") ? table.expression("dt") : std::nullopt;
    auto inner = table.table("until");
    if (!inner)
        return;
    const std::size_t named = ladder.rungs.size();
    ladder.until =
        read_until(*std::move(inner),
                   {"levels", static_cast<std::int64_t>(std::max(least_known_levels, named)),
                    "nothing is known of fewer than " + std::to_string(least_known_levels) +
                        ", and the ladder names " + std::to_string(named)});
    require_wanted(table, *ladder.until, ladder.norms, "the ladder");
    const Rung& first = ladder.rungs.front();
    const Rung& last = ladder.rungs.back();
    if (last.elements < first.elements || last.dt > first.dt ||
        (last.elements == first.elements && last.dt == first.dt))
        throw table.error("until", " goes on as the levels do, and the last is no finer than the "
                                   "first; give at least two, from coarse to fine");
    if (ladder.printed)
        throw table.error("until", " adds levels, and printed has one value for each that there "
                                   "is; remove one of the two");
    ladder.next = next_level(ladder.rungs, ladder.final_time, formula);
}

} // namespace

LadderBlock read_ladder(TableReader& table, const SolverKeys& keys) {
    LadderBlock ladder;
    ladder.final_time = read_final_time(table, keys);
    ladder.rungs = read_rungs(table, ladder.final_time, keys);
    ladder.norms = read_norms(table, keys);
    read_values(table, keys, ladder.norms);
    if (auto printed = table.table("printed"))
        ladder.printed = read_printed(*std::move(printed), ladder, table.place("norms"), keys);
    read_refining(table, ladder);
    ladder.says_orders = keys.any_widths || ladder.until;
    table.finish();
    return ladder;
}

} // namespace tvbeam
