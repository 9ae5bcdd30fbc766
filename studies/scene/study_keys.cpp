#include "studies/scene/study_keys.hpp"

#include "mms/expression/number_expression.hpp"
#include "mms/text/nearest_name.hpp"
#include "studies/scene/toml_reader.hpp"

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
            throw InputError(table.place("dt"),
                             table.full("dt") + " has " + std::to_string(list->size()) +
                                 " values, " + table.full("elements") + " has " +
                                 std::to_string(elements.size()) +
                                 "; give one dt a rung, or one expression in s, e.g. \"0.01/s\"");
        dt = *list;
    } else {
        throw InputError(table.place("dt"), table.full("dt") +
                                                " is missing; give one dt a rung, or one "
                                                "expression in s, e.g. \"0.01/s\"");
    }
    return dt;
}

} // namespace

double read_final_time(TableReader& table) {
    const auto final_time = table.number("final_time");
    if (!final_time)
        throw InputError(table.place("final_time"),
                         table.full("final_time") +
                             " is missing; give the time at which the run ends");
    if (!(*final_time > 0.0))
        throw InputError(table.place("final_time"), table.full("final_time") + " is " +
                                                        message_text(*final_time) +
                                                        "; it must be > 0");
    return *final_time;
}

std::vector<std::int64_t> read_elements(TableReader& table) {
    const auto elements = table.integers("elements");
    if (!elements)
        throw InputError(table.place("elements"),
                         table.full("elements") +
                             " is missing; give the numbers of elements, e.g. [10, 20, 40]");
    if (elements->empty())
        throw InputError(table.place("elements"),
                         table.full("elements") + " is empty; it must hold a number of elements");
    for (std::size_t i = 0; i < elements->size(); ++i)
        if ((*elements)[i] < 1 || (*elements)[i] > most_elements)
            throw InputError(table.place("elements", i),
                             table.full("elements") + " holds " + std::to_string((*elements)[i]) +
                                 "; a mesh has 1 to " + std::to_string(most_elements) +
                                 " elements");
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
                "rung " + std::to_string(i + 1) + " of " + table.full("elements") +
                    " is coarser than the one before it; a ladder goes from coarse to fine");
    std::vector<Rung> rungs;
    for (std::size_t i = 0; i < elements.size(); ++i)
        rungs.push_back({elements[i], steps_of(table, i, final_time, dt[i]), dt[i]});
    return rungs;
}

std::vector<Norm> read_norms(TableReader& table) {
    std::vector<Norm> norms;
    const auto names = table.texts("norms").value_or(std::vector<std::string>{});
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto norm = Norm::named(names[i]);
        if (!norm) {
            std::vector<std::string> known = Norm::names();
            std::string list;
            for (const auto& name : known)
                list += (list.empty() ? "" : ", ") + name;
            throw InputError(table.place("norms", i),
                             "unknown norm '" + names[i] + "'" + did_you_mean(names[i], known) +
                                 "; known: " + list +
                                 ", and their squares with _sq behind the name");
        }
        if (std::any_of(norms.begin(), norms.end(),
                        [&](const Norm& other) { return other.name == norm->name; }))
            throw InputError(table.place("norms", i),
                             table.full("norms") + " names '" + names[i] + "' twice; remove one");
        norms.push_back(*norm);
    }
    return norms;
}

} // namespace tvbeam
