#include "mms/forecast/expected_orders.hpp"
#include "mms/text/toml_document.hpp"
#include "reports/document/json_text.hpp"
#include "reports/document/result_document.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/plots/drawing.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/studies/run_fields.hpp"
#include "reports/sweep/sweep.hpp"
#include "reports/sweep/sweep_rows.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/text/number_text.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tvbeam {

namespace {

/// "4 runs"; nothing where none did.
std::string failed_runs(const Ending& ending) {
    return ending.failures > 0
               ? fmt::format("{} run{}", ending.failures, ending.failures > 1 ? "s" : "")
           : !ending.failed
               ? ""
               : name_of(ending.interrupted ? RungStatus::interrupted : RungStatus::failed);
}

Table table_of(const Sweep& sweep, const std::vector<StudyResult>& results) {
    const auto rows = rows_of(results);
    Table::Group key{"", {{sweep.key, {}}}};
    std::vector<Table::Group> groups;
    for (std::size_t i = 0; i < rows.size(); ++i)
        key.columns[0].cells.push_back(sweep.shown(i));
    for (std::size_t c = 0; !rows.empty() && c < rows.front().size(); ++c) {
        const SweepCell& head = rows.front()[c];
        if (groups.empty() || groups.back().heading != head.group || head.group.empty())
            groups.push_back({head.group, {}});
        Table::Column column{head.heading, {}};
        for (const auto& row : rows) {
            const auto& value = row[c].value;
            column.cells.push_back(!value          ? row[c].without
                                   : head.is_error ? scientific(value, 4)
                                                   : significant(*value, row[c].digits));
        }
        groups.back().columns.push_back(std::move(column));
    }
    if (std::ranges::any_of(results, [](const auto& result) { return result.ending().failed; })) {
        Table::Column runs{"failed", {}};
        for (const auto& result : results)
            runs.cells.push_back(failed_runs(result.ending()));
        groups.push_back({"", {std::move(runs)}});
    }
    return {"Of the finest level of each run: error and observed order, or seconds; p and q of "
            "fits; limits and orders of values; figures of other studies.",
            key, groups};
}

/// Values with their places among the results, in ascending order; none where one is no number.
using Abscissas = std::vector<std::pair<double, std::size_t>>;
Abscissas abscissas_of(const Sweep& sweep, std::size_t count) {
    Abscissas all;
    for (std::size_t i = 0; i < count; ++i)
        if (const auto value = override_number(sweep.values[i]))
            all.emplace_back(*value, i);
    std::sort(all.begin(), all.end());
    return all.size() == count ? all : Abscissas();
}

/// The points of a column, in stretches between those that cannot be drawn.
std::vector<std::string> stretches_of(const std::vector<std::vector<SweepCell>>& rows,
                                      std::size_t c, const Abscissas& abscissas,
                                      bool is_logarithmic) {
    std::vector<std::string> stretches(1);
    for (const auto& [abscissa, i] : abscissas)
        if (const auto value = rows[i][c].value;
            value && std::isfinite(*value) && (!is_logarithmic || *value > 0.0))
            stretches.back() += fmt::format("{} {}\n", abscissa, *value);
        else if (!stretches.back().empty())
            stretches.emplace_back();
    if (stretches.back().empty())
        stretches.pop_back();
    return stretches;
}

Axis sweep_axis(const std::string& key, const Abscissas& abscissas) {
    const double least = abscissas.front().first;
    constexpr double far = 20.0;
    Axis axis{.title = key, .is_logarithmic = least > 0.0 && abscissas.back().first / least > far};
    if (axis.is_logarithmic) {
        std::vector<double> values;
        for (const auto& [value, i] : abscissas)
            values.push_back(value);
        axis.range = range_of(values, 1.5);
        constexpr std::size_t most_ticks = 6;
        if (values.size() <= most_ticks)
            axis.ticks = value_ticks(values, most_ticks);
    }
    return axis;
}

/// Curves over the values, where those are numbers: of the errors, or else of the other figures.
std::vector<Plot> sweep_plots(const Sweep& sweep, const std::vector<StudyResult>& results) {
    const auto rows = rows_of(results);
    const Abscissas abscissas = abscissas_of(sweep, rows.size());
    if (abscissas.size() < 2)
        return {};
    const bool has_errors = std::any_of(rows.front().begin(), rows.front().end(),
                                        [](const SweepCell& cell) { return cell.is_error; });
    Drawing drawing;
    std::size_t series = 0;
    for (std::size_t c = 0; c < rows.front().size(); ++c) {
        const SweepCell& head = rows.front()[c];
        if (head.is_error != has_errors || head.heading == "ord.")
            continue;
        const std::string name = head.group.empty() ? head.heading
                                 : has_errors       ? (head.words.empty() ? head.group : head.words)
                                                    : head.group + ": " + head.heading;
        const auto stretches = stretches_of(rows, c, abscissas, has_errors);
        for (const auto& points : stretches)
            drawing.add_curve({.block = drawing.add_block(name, points)},
                              look_of(series_style(series)),
                              &points == &stretches.front() ? std::optional(name) : std::nullopt);
        series += stretches.empty() ? 0 : 1;
    }
    if (drawing.is_empty())
        return {};
    drawing.x = sweep_axis(sweep.key, abscissas);
    drawing.y = {.title = has_errors ? "error of the finest level" : "figure",
                 .is_logarithmic = has_errors};
    return {{"sweep", fmt::format("{} over {}.", has_errors ? "Errors" : "Figures", sweep.key),
             drawing}};
}

bool has_defect(const std::vector<StudyResult>& results) {
    return std::any_of(results.begin(), results.end(),
                       [](const auto& result) { return result.scene.defect.has_value(); });
}

/// What is said beside a table of one value and holds for its figures in any.
std::vector<std::string> cautions(const StudyResult& result) {
    std::vector<std::string> all = result.remarks;
    if (const auto* ladder = result.get<LadderResult>();
        ladder != nullptr && !ladder->reference_remark.empty())
        all.push_back(ladder->reference_remark);
    if (const auto* orders = result.get<OrdersResult>();
        orders != nullptr && !orders->reference_remark.empty())
        all.push_back(orders->reference_remark);
    if (const auto* race = result.get<WorkPrecisionResult>();
        race != nullptr && !race->busy_remark.empty())
        all.push_back(race->busy_remark);
    if (result.law_distance > 0.0)
        all.push_back(std::string("The solution is one of rigid stops: ") +
                      stalling_errors(result.scene.beam) +
                      " at penalised ones do not fall to zero.");
    return all;
}

/// Why a row is not whole: "beam.alpha = 1e3: the reason"; nothing where all are.
std::vector<std::string> troubles(const Sweep& sweep, const std::vector<StudyResult>& results) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < results.size(); ++i)
        if (const Ending ending = results[i].ending(); ending.failed)
            all.push_back(fmt::format("{} = {}: {}", sweep.key, sweep.shown(i),
                                      ending.reason.empty() ? "a run failed" : ending.reason));
    return all;
}

/// As they were given, the swept one with all of its values.
std::vector<std::string> overrides_of(const Sweep& sweep) {
    return sweep.overrides(fmt::format("{}", fmt::join(sweep.values, ",")));
}

std::string sweep_json(const Sweep& sweep, const std::vector<StudyResult>& results) {
    using Json = nlohmann::ordered_json;
    Json json{{"schema", sweep_schema}, {"key", sweep.key}};
    if (has_defect(results))
        json["defect"] = defect_words;
    if (!results.empty()) {
        json["scene"] = Json::parse(results.front().scene.json()); // of the first value
        json["provenance"] = provenance_json(results.front().scene);
        json["provenance"]["overrides"] = overrides_of(sweep);
    }
    json["interrupted"] = results.size() < sweep.values.size() ||
                          std::any_of(results.begin(), results.end(),
                                      [](const auto& result) { return result.interrupted(); });
    json["rows"] = Json::array();
    const auto rows = rows_of(results);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto value = override_number(sweep.values[i]);
        const auto text = override_text(sweep.values[i]);
        Json row{{"value", value ? Json(*value) : Json(text ? *text : sweep.values[i])}};
        if (const Ending ending = results[i].ending(); ending.failed)
            row["failed"] = ending.reason;
        for (const auto& cell : rows[i]) {
            if (!cell.is_asked)
                continue;
            auto& place = cell.group.empty() ? row[cell.heading] : row[cell.group][cell.heading];
            place = cell.value && std::isfinite(*cell.value) ? Json(*cell.value) : Json();
        }
        json["rows"].push_back(std::move(row));
    }
    return json_text(json);
}

/// All of them, or of many how many and which are the first and the last.
std::string values_text(const std::vector<std::string>& values) {
    constexpr std::size_t most = 12;
    return values.size() <= most ? fmt::format("{}", fmt::join(values, ", "))
                                 : fmt::format("{}, {}, … {} ({} values)", values[0], values[1],
                                               values.back(), values.size());
}

/// Those of all values: each once, and of which values it is, where not of all.
std::vector<std::string> cautions(const Sweep& sweep, const std::vector<StudyResult>& results) {
    std::vector<std::pair<std::string, std::vector<std::string>>> values_of;
    for (std::size_t i = 0; i < results.size(); ++i)
        for (const auto& caution : cautions(results[i])) {
            auto known =
                std::ranges::find(values_of, caution, [](const auto& of) { return of.first; });
            if (known == values_of.end())
                known = values_of.insert(known, {caution, {}});
            if (known->second.empty() || known->second.back() != sweep.shown(i))
                known->second.push_back(sweep.shown(i));
        }
    std::vector<std::string> all;
    all.reserve(values_of.size());
    for (const auto& [caution, values] : values_of)
        all.push_back(values.size() == results.size()
                          ? caution
                          : fmt::format("{} = {}: {}", sweep.key, values_text(values), caution));
    return all;
}

} // namespace

std::string sweep_csv(const Sweep& sweep, const std::vector<StudyResult>& results) {
    const auto rows = rows_of(results);
    std::string text = quoted(sweep.key);
    const std::string comma = ",";
    for (std::size_t c = 0; !rows.empty() && c < rows.front().size(); ++c) {
        const std::string& group = rows.front()[c].group;
        text += comma;
        text += quoted(group.empty() ? rows.front()[c].heading
                                     : fmt::format("{} {}", group, rows.front()[c].heading));
    }
    const bool has_failed = std::ranges::any_of(
        results, [](const StudyResult& result) { return result.ending().failed; });
    if (has_failed)
        text += ",failed";
    text += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += is_plain_word(sweep.shown(i)) ? sweep.shown(i) : quoted(sweep.shown(i));
        for (const auto& cell : rows[i])
            text += cell.value                                    ? fmt::format(",{}", *cell.value)
                    : cell.without == name_of(RungStatus::failed) ? ",nan"
                                                                  : comma;
        if (has_failed)
            text += comma + (results[i].ending().failed ? quoted(results[i].ending().reason) : "");
        text += "\n";
    }
    return text;
}

Reported reported(const Sweep& sweep, const std::vector<StudyResult>& results) {
    Reported all;
    all.document.title = results.empty() ? sweep.key : results.front().scene.title;
    if (has_defect(results))
        all.document.title = std::string(defect_words) + ": " + all.document.title;
    all.document.head = {sweep.key + " = " + values_text(sweep.values)};
    for (auto& caution : cautions(sweep, results))
        all.document.head.push_back(std::move(caution));
    if (!results.empty())
        all.document.provenance = provenance_rows(results.front().scene, overrides_of(sweep));
    if (!results.empty())
        all.document.sections.push_back({"Sweep", {table_of(sweep, results)}});
    for (const auto& trouble : troubles(sweep, results))
        all.document.sections.back().blocks.emplace_back(Finding{trouble});
    all.json = [&sweep, &results] { return sweep_json(sweep, results); };
    all.csvs = [&sweep, &results] {
        return std::vector<NamedText>{{"sweep.csv", sweep_csv(sweep, results)}};
    };
    all.plots = [&sweep, &results] { return sweep_plots(sweep, results); };
    for (std::size_t i = 0; i < results.size(); ++i)
        all.directories.insert(sweep.directory(i));
    for (const auto& result : results) {
        all.failed = all.failed || result.failed();
        all.interrupted = all.interrupted || result.interrupted();
    }
    return all;
}

} // namespace tvbeam
