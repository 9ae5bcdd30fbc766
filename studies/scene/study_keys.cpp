#include "studies/scene/study_keys.hpp"

#include "mms/expression/number_expression.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <cmath>

namespace tvbeam {

namespace {

/// dt as a list of one number a rung, or one expression in s.
std::vector<double> read_dt(TableReader& table, const std::vector<std::int64_t>& elements) {
    std::vector<double> dt;
    if (table.is_string("dt")) {
        const SourceText formula = *table.expression("dt");
        for (const std::int64_t s : elements)
            dt.push_back(number_from_expression(formula, {{"s", static_cast<double>(s)}}));
    } else if (const auto list = table.numbers("dt")) {
        if (list->size() != elements.size())
            throw table.error(
                "dt", " has " + std::to_string(list->size()) + " values, " +
                          table.full("elements") + " has " + std::to_string(elements.size()) +
                          "; give one dt a level, or one expression in s, e.g. \"0.01/s\"");
        dt = *list;
    } else {
        throw table.error("dt", " is missing; give one dt a level, or one "
                                "expression in s, e.g. \"0.01/s\"");
    }
    return dt;
}

const Measure* named(const std::vector<Measure>& measures, const std::string& name) {
    const auto found = std::find_if(measures.begin(), measures.end(),
                                    [&](const Measure& measure) { return measure.name == name; });
    return found == measures.end() ? nullptr : &*found;
}

std::string unknown_norm(const std::string& name, const SolverKeys& keys) {
    std::vector<std::string> roots;
    std::string list;
    for (const auto& measure : keys.measures)
        if (measure.name == measure.root()) {
            roots.push_back(measure.name);
            list += (list.empty() ? "" : ", ") + measure.name;
        }
    const bool squares = roots.size() < keys.measures.size();
    return "unknown norm '" + name + "'" + did_you_mean(name, roots) + "; known: " + list +
           (squares ? ", and their squares with _sq behind the name" : "");
}

} // namespace

double read_final_time(TableReader& table) {
    const auto final_time = table.number("final_time");
    if (!final_time)
        throw table.error("final_time", " is missing; give the time at which the run ends");
    if (!(*final_time > 0.0))
        throw table.error("final_time", " is " + message_text(*final_time) + "; it must be > 0");
    return *final_time;
}

std::vector<std::int64_t> read_elements(TableReader& table) {
    const auto elements = table.integers("elements");
    if (!elements)
        throw table.error("elements",
                          " is missing; give the numbers of elements, e.g. [10, 20, 40]");
    if (elements->empty())
        throw table.error("elements", " is empty; it must hold a number of elements");
    if (elements->size() > most_levels)
        throw table.error("elements", " holds " + std::to_string(elements->size()) +
                                          " numbers; at most " + std::to_string(most_levels) +
                                          " are read");
    for (std::size_t i = 0; i < elements->size(); ++i)
        if ((*elements)[i] < 1 || (*elements)[i] > most_elements)
            throw table.error("elements",
                              " holds " + std::to_string((*elements)[i]) + "; a mesh has 1 to " +
                                  std::to_string(most_elements) + " elements",
                              i);
    return *elements;
}

std::int64_t steps_of(const TableReader& table, std::size_t index, double final_time, double dt) {
    const Place place = table.place("dt", index);
    if (!(dt > 0.0))
        throw InputError(place, table.full("dt") + " is " + message_text(dt) + "; it must be > 0");
    const double ratio = final_time / dt;
    const double steps = std::max(1.0, std::round(ratio));
    if (!(steps <= most_steps))
        throw InputError(place, table.full("dt") + " is " + message_text(dt) + ", which makes " +
                                    message_text(ratio) + " steps; at most 1e12 are possible");
    if (std::abs(ratio - steps) > 1e-9 * steps)
        throw InputError(place, table.full("dt") + " is " + message_text(dt) + "; it must divide " +
                                    "final_time = " + message_text(final_time) +
                                    " into a whole number of steps, not " + message_text(ratio) +
                                    "; the nearest is " + message_text(final_time / steps));
    return static_cast<std::int64_t>(steps);
}

std::vector<Rung> read_rungs(TableReader& table, double final_time) {
    const auto elements = read_elements(table);
    const auto dt = read_dt(table, elements);
    for (std::size_t i = 1; i < elements.size(); ++i)
        if (elements[i] < elements[i - 1] || dt[i] > dt[i - 1])
            throw InputError(
                table.place(elements[i] < elements[i - 1] ? "elements" : "dt", i),
                "level " + std::to_string(i + 1) + " of " + table.full("elements") +
                    " is coarser than the one before it; a ladder goes from coarse to fine");
    std::vector<Rung> rungs;
    for (std::size_t i = 0; i < elements.size(); ++i)
        rungs.push_back({elements[i], steps_of(table, i, final_time, dt[i]), dt[i]});
    return rungs;
}

std::vector<Measure> read_norms(TableReader& table, const SolverKeys& keys) {
    std::vector<Measure> measures;
    const auto names = table.texts("norms").value_or(std::vector<std::string>{});
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Measure* measure = named(keys.measures, names[i]);
        if (measure == nullptr)
            throw InputError(table.place("norms", i), unknown_norm(names[i], keys));
        if (named(measures, names[i]) != nullptr)
            throw table.error("norms", " names '" + names[i] + "' twice; remove one", i);
        measures.push_back(*measure);
    }
    return measures;
}

std::map<std::string, std::vector<double>> read_by_measure(
    TableReader& table, const SolverKeys& keys, const std::vector<Measure>& wanted,
    const std::function<void(const std::string& name, const std::vector<double>&)>& check) {
    std::map<std::string, std::vector<double>> lists;
    for (const auto& measure : keys.measures)
        if (const auto list = table.numbers(measure.name)) {
            check(measure.name, *list);
            if (named(wanted, measure.name) != nullptr)
                lists[measure.name] = *list;
        }
    table.finish();
    return lists;
}

} // namespace tvbeam
