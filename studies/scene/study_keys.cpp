#include "studies/scene/study_keys.hpp"

#include "mms/expression/number_expression.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"

#include <boost/algorithm/string/join.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

namespace tvbeam {

namespace {

/// dt as a list of one number a rung, or one expression in s; empty where it is absent.
std::vector<double> read_dt(TableReader& table, const std::vector<std::int64_t>& elements) {
    std::vector<double> dt;
    if (table.is_string("dt")) {
        const SourceText formula = *table.expression("dt");
        if (elements.empty())
            throw table.error("dt", " is an expression in s, the number of elements, and there "
                                    "are no elements; give a list");
        for (const std::int64_t s : elements)
            dt.push_back(number_from_expression(formula, {{"s", static_cast<double>(s)}}));
    } else if (table.is_number("dt")) {
        throw table.error("dt", " is one number; give a list with one dt a level, or one "
                                "expression in s, e.g. \"0.01/s\", or \"0.01\" for all levels");
    } else if (const auto list = table.numbers("dt")) {
        if (!elements.empty() && list->size() != elements.size())
            throw table.error(
                "dt", " has " + std::to_string(list->size()) + " values, " +
                          table.full("elements") + " has " + std::to_string(elements.size()) +
                          "; give one dt a level, or one expression in s, e.g. \"0.01/s\"");
        dt = *list;
    }
    return dt;
}

const Measure* named(const std::vector<Measure>& measures, const std::string& name) {
    const auto found = std::find_if(measures.begin(), measures.end(),
                                    [&](const Measure& measure) { return measure.name == name; });
    return found == measures.end() ? nullptr : &*found;
}

std::string unknown_norm(const std::string& name, const SolverKeys& keys, bool is_value) {
    std::vector<std::string> roots;
    std::set<std::string> squares;
    for (const auto& measure : keys.measures) {
        if (measure.squared && measure.name != measure.root())
            squares.insert(measure.root());
        if (measure.is_value == is_value && measure.name == measure.root())
            roots.push_back(measure.name);
    }
    const std::string unknown =
        std::string("unknown ") + (is_value ? "value" : "norm") + " '" + name + "'";
    if (roots.empty())
        return unknown + "; [solver] names no " + (is_value ? "values" : "errors");
    std::vector<std::string> without;
    std::ranges::copy_if(roots, std::back_inserter(without),
                         [&](const std::string& root) { return !squares.contains(root); });
    std::string known = boost::algorithm::join(roots, ", ");
    if (!squares.empty())
        known += ", and their squares with _sq behind the name" +
                 (without.empty() ? "" : ", but of " + boost::algorithm::join(without, ", "));
    return unknown + did_you_mean(name, roots) + "; known: " + known;
}

/// The measures that a list names, behind those that are there.
void add_measures(TableReader& table, const std::string& key, bool is_value, const SolverKeys& keys,
                  std::vector<Measure>& measures) {
    const bool any = is_value ? keys.any_value : keys.any_error;
    const auto names = table.texts(key).value_or(std::vector<std::string>{});
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Measure* measure = named(keys.measures, names[i]);
        const bool known = measure != nullptr && measure->is_value == is_value;
        if ((!known && !any) || names[i].empty())
            throw InputError(table.place(key, i), unknown_norm(names[i], keys, is_value));
        if (named(measures, names[i]) != nullptr)
            throw table.error(key, " names '" + names[i] + "' twice; remove one", i);
        measures.push_back(known ? *measure : Measure{.name = names[i], .is_value = is_value});
    }
    for (const auto& measure : measures)
        if (const auto taken = any ? column_of_tables(measure.name, measures) : std::nullopt)
            throw InputError(table.place(key), *taken);
}

} // namespace

std::optional<std::string> column_of_tables(const std::string& name,
                                            const std::vector<Measure>& others) {
    for (const char* column :
         {"scheme", "elements", "h", "dt", "steps", "status", "seconds", "reason"})
        if (name == column)
            return "tables have a column " + name + " of their own; give the number another name";
    for (const auto& [ending, words] : {std::pair("_order", "orders"),
                                        {"_printed", "published figures"},
                                        {"_predicted", "predictions"},
                                        {"_predicted_low", "predictions"},
                                        {"_predicted_high", "predictions"}}) {
        if (!name.ends_with(ending))
            continue;
        const std::string of = name.substr(0, name.size() - std::string_view(ending).size());
        if (named(others, of) != nullptr)
            return fmt::format("tables have a column {} with the {} of {}; give the number another "
                               "name",
                               name, words, of);
    }
    return std::nullopt;
}

double read_final_time(TableReader& table, const SolverKeys& keys) {
    const auto final_time = table.number("final_time");
    if (!final_time && keys.any_widths)
        return 0.0;
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
    if (final_time == 0.0)
        return 0;
    const double ratio = final_time / dt;
    const double steps = std::max(1.0, std::round(ratio));
    if (!(steps <= most_steps))
        throw InputError(place, table.full("dt") + " is " + message_text(dt) + ", which makes " +
                                    (std::isfinite(ratio) ? message_text(ratio) : "over 1e308") +
                                    " steps; at most 1e12 are possible");
    if (std::abs(ratio - steps) > 1e-9 * steps)
        throw InputError(place, table.full("dt") + " is " + message_text(dt) + "; it must divide " +
                                    "final_time = " + message_text(final_time) +
                                    " into a whole number of steps, not " + message_text(ratio) +
                                    "; the nearest is " + message_text(final_time / steps));
    return static_cast<std::int64_t>(steps);
}

std::vector<Rung> read_rungs(TableReader& table, double final_time, const SolverKeys& keys) {
    const auto elements = keys.any_widths && !table.has("elements") && table.has("dt")
                              ? std::vector<std::int64_t>()
                              : read_elements(table);
    const auto dt = read_dt(table, elements);
    if (dt.empty() && (!keys.any_widths || elements.empty() || table.has("dt")))
        throw table.error("dt", " is missing; give one dt a level, or one "
                                "expression in s, e.g. \"0.01/s\"");
    std::vector<Rung> rungs(std::max(elements.size(), dt.size()));
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        if (!elements.empty())
            rungs[i].elements = elements[i];
        if (dt.empty())
            continue;
        rungs[i].dt = dt[i];
        rungs[i].steps = steps_of(table, i, final_time, dt[i]);
    }
    for (std::size_t i = 1; i < rungs.size(); ++i)
        if (rungs[i].elements < rungs[i - 1].elements || rungs[i].dt > rungs[i - 1].dt)
            throw table.error(
                rungs[i].elements < rungs[i - 1].elements ? "elements" : "dt",
                ": level " + std::to_string(i + 1) +
                    " is coarser than the one before it; a ladder goes from coarse to fine",
                i);
    return rungs;
}

std::vector<Measure> read_norms(TableReader& table, const SolverKeys& keys) {
    std::vector<Measure> measures;
    add_measures(table, "norms", false, keys, measures);
    return measures;
}

void read_values(TableReader& table, const SolverKeys& keys, std::vector<Measure>& measures) {
    if (keys.any_value || std::any_of(keys.measures.begin(), keys.measures.end(),
                                      [](const Measure& measure) { return measure.is_value; }))
        add_measures(table, "values", true, keys, measures);
}

std::map<std::string, std::vector<double>> read_by_measure(
    TableReader& table, const SolverKeys& keys, const std::vector<Measure>& wanted,
    const Place& norms,
    const std::function<void(const std::string& name, const std::vector<double>&)>& check) {
    std::map<std::string, std::vector<double>> lists;
    auto known = keys.measures;
    for (const auto& measure : wanted)
        if (named(known, measure.name) == nullptr)
            known.push_back(measure);
    std::erase_if(known, [&](const Measure& measure) { return table.owns(measure.name); });
    std::string unwanted;
    for (const auto& measure : known)
        if (const auto list = table.numbers(measure.name)) {
            check(measure.name, *list);
            if (named(wanted, measure.name) != nullptr)
                lists[measure.name] = *list;
            else
                unwanted = measure.name;
        }
    table.finish();
    const bool are_norms_of_the_file = !norms.file.starts_with("--set ");
    if (lists.empty() && !unwanted.empty() && are_norms_of_the_file)
        throw table.error(unwanted, " is not among the norms, and neither is another of " +
                                        table.full("") +
                                        ": none of it would be shown; name it in "
                                        "norms, or --set " +
                                        table.full("") + "={}");
    return lists;
}

} // namespace tvbeam
