#include "reports/sweep/sweep.hpp"

#include "mms/forecast/expected_orders.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/toml_document.hpp"
#include "reports/document/json_text.hpp"
#include "reports/document/result_document.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/plots/drawing.hpp"
#include "reports/plots/plot_style.hpp"
#include "reports/studies/run_fields.hpp"
#include "studies/grid/grid.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/text/number_text.hpp"
#include "studies/work_precision/work_precision.hpp"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

namespace tvbeam {

namespace {

constexpr const char* sweep_schema = "tvbeam-sweep/1";

bool is_word(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '.' || c == '-' || c == '+' || c == '_';
    });
}

/// A word that no file of the sweep itself has, and no name of another directory: of those with a
/// dot numbers alone, and none as those of values that are not words.
bool is_directory_name(const std::string& text) {
    double number = 0.0;
    const char* const end = text.data() + text.size();
    return is_word(text) && text != "plots" && text.front() != '.' &&
           text.find("-of-") == std::string::npos &&
           (text.find('.') == std::string::npos ||
            std::from_chars(text.data() + (text.front() == '+' ? 1 : 0), end, number).ptr == end);
}

bool is_between(const std::string& text, char first, char last) {
    return text.size() > 1 && text.front() == first && text.back() == last;
}

/// Where a value that begins at `begin` ends: at a comma outside quotes and brackets, or the end.
std::size_t end_of_value(const std::string& text, std::size_t begin) {
    int depth = 0;
    char quote = 0;
    for (std::size_t i = begin; i < text.size(); ++i) {
        const char c = text[i];
        if (quote == '"' && c == '\\')
            ++i;
        else if (quote != 0)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '[' || c == ']')
            depth += c == '[' ? 1 : -1;
        else if (c == ',' && depth == 0)
            return i;
    }
    return text.size();
}

/// Parts between commas; empty where they are no words, texts in quotes and lists in brackets.
std::vector<std::string> values_in(const std::string& text) {
    std::vector<std::string> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = end_of_value(text, begin);
        const std::string part = text.substr(begin, end - begin);
        if (!is_word(part) && !is_between(part, '[', ']') && !is_between(part, '"', '"') &&
            !is_between(part, '\'', '\''))
            return {};
        values.push_back(part);
        begin = end + 1;
    }
    return values;
}

/// A figure of a result: what it is of, and what.
struct Cell {
    std::string group;
    std::string heading;
    std::optional<double> value;
    bool is_error = false;
    std::string words = {};   ///< of the norm
    std::string without = {}; ///< what the table shows where there is no value
    bool is_asked = true;     ///< for this value of the key
    int digits = 4;           ///< that the table shows, but of an error
};

/// An order or a limit where it is determined, and by the finest run, too.
Cell estimate_cell(const std::string& group, const std::string& heading, const OrderInterval& of,
                   const std::vector<RungResult>& runs) {
    const bool no_finest = finest_failed(runs);
    return {.group = group,
            .heading = heading,
            .value = of.determined && !no_finest ? std::optional(of.value) : std::nullopt,
            .without = no_finest ? name_of(RungStatus::failed) : ""};
}

Cell limit_cell(const std::string& group, const OrderInterval& of,
                const std::vector<RungResult>& runs) {
    Cell cell = estimate_cell(group, "limit", of, runs);
    if (cell.value)
        cell.digits = digits_within(of.value, of.half_width());
    return cell;
}

void add_ladder(const LadderResult& ladder, std::vector<Cell>& cells) {
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

void add_orders(const OrdersResult& orders, std::vector<Cell>& cells) {
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
              std::vector<Cell>& cells) {
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

std::vector<Cell> cells_of(const StudyResult& result) {
    std::vector<Cell> cells;
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

/// The cells of all results, matched by what they are; what one was not asked for is empty.
std::vector<std::vector<Cell>> rows_of(const std::vector<StudyResult>& results) {
    std::vector<std::vector<Cell>> rows;
    std::vector<Cell> all;
    const auto same = [](const Cell& a, const Cell& b) {
        return a.group == b.group && a.heading == b.heading;
    };
    for (const auto& result : results) {
        rows.push_back(cells_of(result));
        for (const auto& cell : rows.back())
            if (std::none_of(all.begin(), all.end(),
                             [&](const Cell& known) { return same(known, cell); }))
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
        const Cell& head = rows.front()[c];
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
std::vector<std::string> stretches_of(const std::vector<std::vector<Cell>>& rows, std::size_t c,
                                      const Abscissas& abscissas, bool is_logarithmic) {
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
                                        [](const Cell& cell) { return cell.is_error; });
    Drawing drawing;
    std::size_t series = 0;
    for (std::size_t c = 0; c < rows.front().size(); ++c) {
        const Cell& head = rows.front()[c];
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

/// The overrides that the result in a directory was made with; none where it has another schema.
std::vector<std::string> overrides_in(const std::filesystem::path& directory,
                                      const std::string& schema) {
    std::ifstream stream(directory / "result.json");
    try {
        const auto json = nlohmann::json::parse(stream);
        if (json.at("schema") == schema)
            return json.at("provenance").at("overrides").get<std::vector<std::string>>();
    } catch (const nlohmann::json::exception&) { // no result
    }
    return {};
}

/// Of the result in a directory: those that are in every one, and those that say whose they are.
std::vector<std::filesystem::path> files_of_result(const std::filesystem::path& directory) {
    std::vector<std::filesystem::path> files;
    for (const auto& format : report_formats()) {
        for (const auto& name : format->certain_files())
            if (!name.starts_with("plots/"))
                files.emplace_back(name);
        for (auto& file : format->earlier_files(directory))
            files.push_back(std::move(file));
    }
    files.emplace_back("plots");
    return files;
}

} // namespace

std::vector<std::filesystem::path> files_of_sweep(const std::filesystem::path& directory) {
    std::optional<Sweep> sweep;
    try {
        sweep = sweep_in(overrides_in(directory, sweep_schema));
    } catch (const InputError&) { // none of ours
    }
    if (!sweep)
        return {};
    std::vector<std::filesystem::path> files;
    if (first_line(directory / "sweep.csv").starts_with(tvbeam::quoted(sweep->key)))
        files.emplace_back("sweep.csv");
    for (std::size_t i = 0; i < sweep->values.size(); ++i) {
        const std::filesystem::path name = sweep->directory(i);
        if (std::filesystem::is_symlink(directory / name) ||
            overrides_in(directory / name, "tvbeam-result/1") != sweep->overrides(sweep->values[i]))
            continue;
        for (const auto& file : files_of_result(directory / name))
            files.push_back(name / file);
        files.push_back(name);
    }
    return files;
}

std::vector<std::string> Sweep::overrides(const std::string& value) const {
    auto all = others;
    all.push_back(key + "=" + value);
    return all;
}

std::string Sweep::shown(std::size_t i) const {
    const auto text = override_text(values[i]);
    return text && !text->empty() && override_text(*text) == text ? *text : values[i];
}

std::string Sweep::directory(std::size_t i) const {
    return is_directory_name(shown(i)) ? shown(i) : fmt::format("{}-of-{}", i + 1, values.size());
}

std::optional<Sweep> sweep_in(const std::vector<std::string>& overrides) {
    std::optional<Sweep> sweep;
    std::vector<std::string> others;
    for (const auto& assignment : overrides) {
        const auto equals = std::min(assignment.find('='), assignment.size());
        const auto given = equals < assignment.size() ? values_in(assignment.substr(equals + 1))
                                                      : std::vector<std::string>();
        const std::string key = assignment.substr(0, equals);
        if (given.size() < 2 || key == "title") {
            others.push_back(assignment);
            continue;
        }
        if (sweep)
            throw InputError({"--set " + assignment},
                             "one key is swept at a time, and " + sweep->key + " is already");
        std::set<std::string> values;
        for (const auto& word : given) {
            const auto value = override_number(word);
            const auto text = override_text(word);
            if (!values.insert(value  ? fmt::format("{}", *value)
                               : text ? '"' + *text
                                      : word)
                     .second)
                throw InputError({"--set " + assignment},
                                 word + " is there twice; name each value once");
        }
        sweep = Sweep{key, given, {}};
    }
    for (const auto& other : others)
        if (sweep && other.substr(0, other.find('=')) == sweep->key)
            throw InputError({"--set " + other},
                             sweep->key + " is swept, and cannot have one value as well");
    if (sweep)
        sweep->others = std::move(others);
    return sweep;
}

void require_names_of_rows(const Sweep& sweep, const Scene& scene) {
    const auto* ladder = scene.get<LadderBlock>();
    if (ladder == nullptr)
        return;
    for (const auto& norm : ladder->norms)
        for (const char* key : {"value", "failed"})
            if (norm.name == key)
                throw InputError({"--set " + sweep.key},
                                 "the rows of a sweep have a " + norm.name +
                                     " of their own; give the number of the solver another name");
}

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
        text += is_word(sweep.shown(i)) ? sweep.shown(i) : quoted(sweep.shown(i));
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
