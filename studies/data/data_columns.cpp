#include "studies/data/data_columns.hpp"

#include "mms/text/nearest_name.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <tuple>

namespace tvbeam {

namespace {

bool is_among(std::initializer_list<const char*> names, const std::string& name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* one) { return boost::algorithm::iequals(one, name); });
}

/// Names that counts of things go by; h = n^(-1/d) of them.
bool is_count(const std::string& name) {
    return is_among({"elements", "cells", "ndofs", "ndof", "dofs", "dof", "n", "nx", "nodes",
                     "nelem", "ncell", "ncells", "unknowns", "points", "size"},
                    name);
}

/// Names of widths, which no dimension turns into others.
bool is_width(const std::string& name) {
    return is_among({"h", "hx", "hy", "hz", "hmax", "hmin", "h_max", "h_min", "dx", "dy", "dz",
                     "width", "spacing"},
                    name);
}

/// Names of numbers of time steps; Δt = 1/n of them.
bool is_step_count(const std::string& name) {
    return is_among({"steps", "nsteps", "n_steps", "timesteps", "nt"}, name);
}

/// The widths that a choice names, or those that need no name.
void choose_widths(const ColumnNames& names, const DataChoice& choice, DataFile& data,
                   std::vector<ColumnUse>& uses) {
    std::vector<std::string> sizes = choice.sizes;
    if (sizes.empty())
        for (const char* name : {"h", "elements"})
            if (sizes.empty() && names.find(name))
                sizes.emplace_back(name);
    for (const auto& size : sizes) {
        ColumnUse use{names.need(size, "--size"), true};
        if (choice.dimension && is_width(size))
            throw InputError(names.place, "column " + size +
                                              " is a width already; --dimension is for numbers of "
                                              "cells or unknowns");
        const bool counts = choice.dimension || is_count(size);
        const std::string name = !counts ? size : sizes.size() == 1 ? "h" : "h_" + size;
        if (counts) {
            const double dimension = choice.dimension.value_or(1.0);
            use.power = -1.0 / dimension;
            data.remarks.push_back(
                name + " = " +
                (dimension == 1.0 ? "1/" + size : size + "^(-1/" + shortest(dimension) + ")") +
                (choice.dimension || size == "elements"
                     ? ""
                     : ": dimension 1 was assumed; --dimension D says another"));
        }
        data.widths.push_back({name, {}});
        uses.push_back(use);
    }
    const auto step =
        choice.step ? std::optional(names.need(*choice.step, "--step")) : names.find("dt");
    if (step && std::none_of(uses.begin(), uses.end(),
                             [&](const ColumnUse& use) { return use.column == *step; })) {
        const std::string name = choice.step.value_or("dt");
        const bool counts = is_step_count(name);
        if (counts)
            data.remarks.push_back("dt = 1/" + name + ": the time 1 was assumed");
        data.widths.push_back({counts ? "dt" : name, {}});
        uses.push_back({*step, true, counts ? -1.0 : 1.0});
    }
    if (uses.empty())
        throw InputError(names.place, "no column h, elements or dt among " +
                                          boost::algorithm::join(names.all, ", ") +
                                          "; say what was refined with --size NAME or --step NAME");
    for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (data.widths[i].name == data.widths[k].name)
                throw InputError(names.place, "two widths would be called " + data.widths[i].name +
                                                  ": those of the columns " +
                                                  names.all[uses[k].column] + " and " +
                                                  names.all[uses[i].column] +
                                                  "; give one of them another name");
    for (std::size_t i = 0; i < uses.size(); ++i)
        uses[i].target = &data.widths[i];
}

void choose_figures(const ColumnNames& names, const DataChoice& choice, DataFile& data,
                    std::vector<ColumnUse>& uses) {
    std::vector<std::string> errors = choice.errors;
    std::vector<std::string> values = choice.values;
    if (errors.empty() && values.empty()) {
        if (names.find("error"))
            errors.emplace_back("error");
        else if (names.find("value"))
            values.emplace_back("value");
        else
            static_cast<void>(names.need("error", "--error")); // says which columns there are
    }
    for (const auto& [chosen, columns, option] :
         {std::tuple(&errors, &data.errors, "--error"), {&values, &data.values, "--value"}}) {
        for (const auto& name : *chosen) {
            uses.push_back({names.need(name, option)});
            columns->push_back({name, {}});
        }
        const auto first = uses.size() - chosen->size();
        for (std::size_t i = 0; i < chosen->size(); ++i)
            uses[first + i].target = &(*columns)[i];
    }
    if (choice.sigma) {
        if (errors.size() + values.size() > 1)
            throw InputError(names.place, "--sigma is of one column; analyse the columns one by "
                                          "one, each with its own");
        uses.push_back({names.need(*choice.sigma, "--sigma")});
        uses.back().plain = &data.sigma;
    }
}

/// A figure is no width, no other figure and no deviation of itself.
void require_one_meaning_each(const ColumnNames& names, const std::vector<ColumnUse>& uses) {
    for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (uses[i].column == uses[k].column)
                throw InputError(names.place, "column " + names.all[uses[i].column] +
                                                  " is asked for twice: a column is a width, an "
                                                  "error, a value or a deviation, once");
}

/// In what is written of a result each width and each figure has a column by its name, beside an
/// error those of its orders and verdicts; rows of JSON have keys by the names of widths.
void require_one_column_each(const ColumnNames& names, const DataFile& data) {
    std::set<std::string> columns;
    const auto add = [&](const std::string& column) {
        if (!columns.insert(column).second)
            throw InputError(names.place, "two columns of the result would be called " + column +
                                              "; give one of them another name, or analyse its "
                                              "column by itself");
    };
    for (const auto& width : data.widths) {
        for (const char* key : {"value", "error", "order", "verdict", "reason"})
            if (width.name == key)
                throw InputError(names.place, "a width cannot be called " + width.name +
                                                  ", as rows of the result have one of their own; "
                                                  "give the column another name");
        add(width.name);
    }
    for (const auto& error : data.errors)
        for (const char* ending : {"", "_order", "_verdict"})
            add(error.name + ending);
    for (const auto& value : data.values)
        add(value.name);
}

/// Whether an error is less where the number is the greatest than where it is the least, of the
/// rows that have one.
bool falls_with(const DataColumn& errors, const std::vector<double>& numbers) {
    std::optional<std::size_t> coarsest;
    std::optional<std::size_t> finest;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!std::isfinite(errors.numbers[i]))
            continue;
        coarsest = !coarsest || numbers[i] < numbers[*coarsest] ? i : *coarsest;
        finest = !finest || numbers[i] > numbers[*finest] ? i : *finest;
    }
    return coarsest && numbers[*coarsest] < numbers[*finest] &&
           errors.numbers[*finest] < errors.numbers[*coarsest];
}

} // namespace

std::optional<std::size_t> ColumnNames::find(const std::string& name) const {
    for (const bool exactly : {true, false}) {
        const auto is_it = [&](const std::string& one) {
            return exactly ? one == name : boost::algorithm::iequals(one, name);
        };
        const auto at = std::find_if(all.begin(), all.end(), is_it);
        if (at == all.end())
            continue;
        if (std::find_if(at + 1, all.end(), is_it) != all.end())
            throw InputError(place, "names the column " + name + " twice; which is meant?");
        return static_cast<std::size_t>(at - all.begin());
    }
    return std::nullopt;
}

std::size_t ColumnNames::need(const std::string& name, const std::string& option) const {
    if (const auto found = find(name))
        return *found;
    throw InputError(place, "no column '" + name + "'" + did_you_mean(name, all) + " among " +
                                boost::algorithm::join(all, ", ") + "; choose one with " + option +
                                " NAME, in a scene " + option.substr(2) + " = [\"NAME\"]");
}

std::vector<ColumnUse> choose_columns(const ColumnNames& names, const DataChoice& choice,
                                      DataFile& data) {
    std::vector<ColumnUse> uses;
    choose_widths(names, choice, data, uses);
    choose_figures(names, choice, data, uses);
    require_one_meaning_each(names, uses);
    require_one_column_each(names, data);
    return uses;
}

void take_whole_sizes_for_counts(const DataChoice& choice, DataFile& data) {
    const auto named = [&](const std::string& name) {
        return std::ranges::find_if(data.widths, [&](const auto& one) { return one.name == name; });
    };
    for (const auto& size : choice.sizes) {
        const auto width = named(size);
        if (width == data.widths.end() || is_width(size) ||
            !std::ranges::all_of(width->numbers, [](double number) {
                return number >= 1.0 && std::floor(number) == number;
            }))
            continue;
        if (data.errors.empty())
            data.remarks.push_back(size + " was taken for a width; --dimension D says that it "
                                          "counts what fills a domain");
        if (std::ranges::none_of(data.errors, [&](const DataColumn& errors) {
                return falls_with(errors, width->numbers);
            }))
            continue;
        for (double& number : width->numbers)
            number = 1.0 / number;
        width->units.clear();
        const std::string name = choice.sizes.size() == 1 ? "h" : "h_" + size;
        if (named(name) == data.widths.end())
            width->name = name;
        data.remarks.push_back(width->name + " = 1/" + size +
                               ", as its numbers are whole: dimension 1 was assumed; --dimension D "
                               "says another, a name as h or dx that they are widths");
    }
}

} // namespace tvbeam
