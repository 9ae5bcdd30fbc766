#include "studies/ladder/ladder_block.hpp"

#include "mms/expression/number_expression.hpp"
#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tvbeam {

namespace {

PublishedFigures read_printed(TableReader table, const LadderBlock& ladder,
                              const SolverKeys& keys) {
    PublishedFigures printed;
    printed.source = table.text("source").value_or("published");
    printed.figures = read_by_measure(
        table, keys, ladder.norms, [&](const std::string& name, const std::vector<double>& list) {
            if (list.size() != ladder.rungs.size())
                throw table.error(name, " has " + std::to_string(list.size()) + " values for " +
                                            std::to_string(ladder.rungs.size()) +
                                            " levels; give one a level, or none: --set " +
                                            table.full("").substr(0, table.full("").size() - 1) +
                                            "={}");
        });
    return printed;
}

/// How the rungs go on. formula: dt as an expression in s, if it is one.
std::optional<Rung> next_level(const std::vector<Rung>& rungs, double final_time,
                               const std::optional<SourceText>& formula) {
    const Rung& before = rungs[rungs.size() - 2];
    const Rung& last = rungs.back();
    Rung next;
    if (last.has_mesh()) {
        const double ratio =
            static_cast<double>(last.elements) / static_cast<double>(before.elements);
        next.elements = std::llround(static_cast<double>(last.elements) * ratio);
        if (next.elements > most_elements)
            return std::nullopt;
    }
    if (!last.has_steps())
        return next;
    next.dt = formula
                  ? number_from_expression(*formula, {{"s", static_cast<double>(next.elements)}})
                  : last.dt * (last.dt / before.dt);
    if (!(next.dt > 0.0) || final_time / next.dt > most_steps)
        return std::nullopt;
    if (final_time > 0.0) {
        next.steps = std::max<std::int64_t>(1, std::llround(final_time / next.dt));
        const double whole = final_time / static_cast<double>(next.steps);
        if (std::abs(whole - next.dt) > 1e-9 * next.dt)
            next.dt = whole;
    }
    return next;
}

Until read_until(TableReader table) {
    Until until;
    const auto positive = [&](const char* key) {
        const auto number = table.number(key);
        if (number && !(*number > 0.0))
            throw table.error(key, " is " + message_text(*number) + "; it must be > 0");
        return number;
    };
    until.order = positive("order");
    until.limit = positive("limit");
    until.seconds = positive("seconds");
    until.levels = table.integer("levels");
    table.finish();
    if (!until.order && !until.limit)
        throw table.error("", " says nothing of what is to be known; give order = 0.05, half of "
                              "the 95 % interval of the order, or limit, the same of a value");
    if (!until.seconds && !until.levels)
        throw table.error("", " has no end; give it a budget: seconds, or levels");
    return until;
}

/// Levels that `until` adds are not those of a list.
void read_refining(TableReader& table, LadderBlock& ladder) {
    const std::optional<SourceText> formula =
        table.is_string("dt") ? table.expression("dt") : std::nullopt;
    auto inner = table.table("until");
    if (!inner)
        return;
    ladder.until = read_until(*std::move(inner));
    const auto has = [&](bool value) {
        return std::any_of(ladder.norms.begin(), ladder.norms.end(),
                           [&](const Measure& measure) { return measure.is_value == value; });
    };
    for (const auto& [key, wanted, is_value] :
         {std::tuple("order", ladder.until->order, false), {"limit", ladder.until->limit, true}})
        if (wanted && !has(is_value))
            throw table.error("until", std::string(" asks for a known ") + key +
                                           ", and the ladder names no " +
                                           (is_value ? "values" : "norms"));
    const std::size_t count = ladder.rungs.size();
    if (count < 2 || (ladder.rungs[count - 1].elements == ladder.rungs[count - 2].elements &&
                      ladder.rungs[count - 1].dt == ladder.rungs[count - 2].dt))
        throw table.error("until", " goes on as the last two levels do; give two that differ");
    if (ladder.printed)
        throw table.error("until", " adds levels, and printed has one value for each that there "
                                   "is; remove one of the two");
    ladder.next = [final_time = ladder.final_time, formula](const std::vector<Rung>& rungs) {
        return next_level(rungs, final_time, formula);
    };
}

} // namespace

LadderBlock read_ladder(TableReader& table, const SolverKeys& keys) {
    LadderBlock ladder;
    ladder.final_time = read_final_time(table, keys);
    ladder.rungs = read_rungs(table, ladder.final_time, keys);
    ladder.norms = read_norms(table, keys);
    read_values(table, keys, ladder.norms);
    if (auto printed = table.table("printed"))
        ladder.printed = read_printed(*std::move(printed), ladder, keys);
    read_refining(table, ladder);
    ladder.says_orders = keys.any_widths || ladder.until;
    table.finish();
    return ladder;
}

} // namespace tvbeam
