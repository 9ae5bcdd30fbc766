#include "reports/sweep/sweep_rows.hpp"

#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/text/number_text.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

namespace {

/// An order or a limit where it is determined, and by the finest run, too.
SweepCell estimate_cell(const std::string& group, const std::string& heading,
                        const OrderInterval& of, const std::vector<RungResult>& runs) {
    const bool no_finest = finest_failed(runs);
    return {.group = group,
            .heading = heading,
            .value = of.determined && !no_finest ? std::optional(of.value) : std::nullopt,
            .without = no_finest ? name_of(RungStatus::failed) : ""};
}

SweepCell limit_cell(const std::string& group, const OrderInterval& of,
                     const std::vector<RungResult>& runs) {
    SweepCell cell = estimate_cell(group, "limit", of, runs);
    if (cell.value)
        cell.digits = digits_within(of.value, of.half_width());
    return cell;
}

void add_ladder(const LadderResult& ladder, std::vector<SweepCell>& cells) {
    const RungResult& finest = ladder.rungs.back();
    for (std::size_t k = 0; k < ladder.norms.size(); ++k) {
        const Measure& norm = ladder.norms[k].norm;
        cells.push_back({norm.name, norm.is_value ? "value" : "error", error_of(finest, k),
                         !norm.is_value, norm.words, name_of(finest.status)});
        if (!norm.is_value) {
            cells.push_back({norm.name, "ord.", ladder.norms[k].orders.back(), false});
        } else if (ladder.analysis) {
            const LimitEstimate& of = *ladder.analysis->columns[k].limit;
            cells.push_back(limit_cell(norm.name, of.limit, ladder.rungs));
            cells.push_back(estimate_cell(norm.name, "ord.", of.order, ladder.rungs));
        }
    }
}

void add_orders(const OrdersResult& orders, std::vector<SweepCell>& cells) {
    for (const auto& [norm, fit, rounding] : orders.norms)
        for (const auto& [heading, order] : {std::pair("p", &fit.p), std::pair("q", &fit.q)})
            cells.push_back(estimate_cell(norm + " (fit)", heading,
                                          fit.holds() ? *order : OrderInterval(), orders.runs));
    for (const auto& value : orders.values) {
        const std::string group = value.value + " (grid)";
        cells.push_back(limit_cell(group, value.limit, orders.runs));
        cells.push_back(estimate_cell(group, "p", value.p, orders.runs));
        cells.push_back(estimate_cell(group, "q", value.q, orders.runs));
    }
}

/// Of each scheme the finest row, its error and its time; and who reaches a target after how long.
void add_race(const WorkPrecisionResult& race, const WorkPrecisionBlock& block,
              std::vector<SweepCell>& cells) {
    const auto median = [](const std::optional<Timing>& timing) {
        return timing ? std::optional(timing->median) : std::nullopt;
    };
    for (std::size_t j = 0; j < block.schemes.size(); ++j) {
        const std::string& name = block.schemes[j].name;
        const std::string group = "work_precision." + name;
        const RungResult& finest = race.schemes[j].runs.back();
        for (std::size_t k = 0; k < block.norms.size(); ++k)
            cells.push_back({group, block.norms[k].name, error_of(finest, k), true,
                             name + ": " + block.norms[k].words, name_of(finest.status)});
        cells.push_back({group, "seconds", median(race.schemes[j].timings.back()), false});
    }
    for (const auto& costs : race.norms)
        for (const auto& reached : costs.errors)
            for (std::size_t j = 0; reached.target && j < block.schemes.size(); ++j)
                cells.push_back(
                    {fmt::format("seconds to {} = {}", costs.norm.name, shortest(reached.error)),
                     block.schemes[j].name, median(reached.times[j]), false});
}

std::vector<SweepCell> cells_of(const StudyResult& result) {
    std::vector<SweepCell> cells;
    if (const auto* ladder = result.get<LadderResult>())
        add_ladder(*ladder, cells);
    if (const auto* orders = result.get<OrdersResult>())
        add_orders(*orders, cells);
    if (const auto* race = result.get<WorkPrecisionResult>())
        add_race(*race, *result.scene.get<WorkPrecisionBlock>(), cells);
    for (const auto& [kind, record] : result.records.entries()) {
        const Ending ending = kind->ending(record);
        for (const auto& [name, figure] : kind->figures(record))
            // Defects have names of the user's, which could be those of other figures.
            cells.push_back({.group = kind->judges_expectations() ? kind->name() : "",
                             .heading = name,
                             .value = ending.failed && std::isnan(figure) ? std::nullopt
                                                                          : std::optional(figure),
                             .without = name_of(ending.interrupted ? RungStatus::interrupted
                                                                   : RungStatus::failed)});
    }
    return cells;
}

} // namespace

std::vector<std::vector<SweepCell>> rows_of(const std::vector<StudyResult>& results) {
    std::vector<std::vector<SweepCell>> rows;
    std::vector<SweepCell> all;
    const auto same = [](const SweepCell& a, const SweepCell& b) {
        return a.group == b.group && a.heading == b.heading;
    };
    for (const auto& result : results) {
        rows.push_back(cells_of(result));
        for (const auto& cell : rows.back())
            if (std::none_of(all.begin(), all.end(),
                             [&](const SweepCell& known) { return same(known, cell); }))
                all.push_back({.group = cell.group,
                               .heading = cell.heading,
                               .value = {},
                               .is_error = cell.is_error,
                               .words = cell.words,
                               .is_asked = false});
    }
    for (auto& row : rows) {
        auto filled = all;
        for (auto& cell : filled)
            for (const auto& given : row)
                if (same(cell, given))
                    cell = given;
        row = std::move(filled);
    }
    return rows;
}

} // namespace tvbeam
