#include "studies/ladder/ladder_block.hpp"

#include "mms/expression/number_expression.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/orders/order_engine.hpp"

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

/// Without what the last digits of a power add to it: 2, where it is 1.9999999999999998.
double rounded(double ratio) {
    constexpr double digits = 1e9;
    return std::round(ratio * digits) / digits;
}

/// How levels are added to a ladder.
class NextLevel {
public:
    /// named: the levels of the scene, the last of which differs from the first. formula: dt as an
    /// expression in s, if it is one.
    NextLevel(const std::vector<Rung>& named, double final_time, std::optional<SourceText> formula)
        : last_named_(named.back()), count_(named.size()), final_time_(final_time),
          formula_(std::move(formula)) {
        const Rung& first = named.front();
        const double root = 1.0 / static_cast<double>(count_ - 1);
        const double elements = first.has_mesh() ? static_cast<double>(last_named_.elements) /
                                                       static_cast<double>(first.elements)
                                                 : 1.0;
        const double steps = first.has_steps() ? first.dt / last_named_.dt : 1.0;
        // Both by the same power, so that the path through h and dt stays the same.
        const double refined = elements > 1.0 ? elements : steps;
        const double power = std::max(root, std::log(least_ratio_of_levels) / std::log(refined));
        elements_ = rounded(std::pow(elements, power));
        steps_ = rounded(std::pow(steps, power));
    }

    std::optional<Rung> operator()(const std::vector<Rung>& levels) const {
        const auto added = static_cast<double>(levels.size() + 1 - count_);
        Rung next;
        if (last_named_.has_mesh()) {
            const double elements =
                static_cast<double>(last_named_.elements) * std::pow(elements_, added);
            if (!(elements <= static_cast<double>(most_elements)))
                return std::nullopt;
            next.elements = std::llround(elements);
        }
        return last_named_.has_steps() ? with_steps(next, added) : next;
    }

private:
    [[nodiscard]] std::optional<Rung> with_steps(Rung next, double added) const {
        next.dt = formula_ ? number_from_expression(*formula_,
                                                    {{"s", static_cast<double>(next.elements)}})
                           : last_named_.dt / std::pow(steps_, added);
        if (!(next.dt > 0.0) || final_time_ / next.dt > most_steps)
            return std::nullopt;
        if (final_time_ > 0.0) {
            next.steps = std::max<std::int64_t>(1, std::llround(final_time_ / next.dt));
            const double whole = final_time_ / static_cast<double>(next.steps);
            if (std::abs(whole - next.dt) > 1e-9 * next.dt)
                next.dt = whole;
        }
        return next;
    }

    Rung last_named_;
    std::size_t count_;
    double final_time_;
    std::optional<SourceText> formula_;
    double elements_ = 1.0; ///< by which a level has more
    double steps_ = 1.0;
};

/// named: how many levels the ladder names.
Until read_until(TableReader table, std::size_t named) {
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
    if (until.order && !(*until.order > OrderTuning().narrowest))
        throw table.error("order", " is " + message_text(*until.order) +
                                       "; no interval is that narrow: it must be > " +
                                       message_text(OrderTuning().narrowest));
    const auto fewest = static_cast<std::int64_t>(std::max(least_known_levels, named));
    if (until.levels && *until.levels < fewest)
        throw table.error("levels", " is " + std::to_string(*until.levels) +
                                        "; it must be >= " + std::to_string(fewest) +
                                        ", all levels together: nothing is known of fewer than " +
                                        std::to_string(least_known_levels) +
                                        ", and the ladder names " + std::to_string(named));
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
    ladder.until = read_until(*std::move(inner), ladder.rungs.size());
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
    const Rung& first = ladder.rungs.front();
    const Rung& last = ladder.rungs.back();
    if (last.elements < first.elements || last.dt > first.dt ||
        (last.elements == first.elements && last.dt == first.dt))
        throw table.error("until", " goes on as the levels do, and the last is no finer than the "
                                   "first; give at least two, from coarse to fine");
    if (ladder.printed)
        throw table.error("until", " adds levels, and printed has one value for each that there "
                                   "is; remove one of the two");
    ladder.next = NextLevel(ladder.rungs, ladder.final_time, formula);
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
