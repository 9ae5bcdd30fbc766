#include "studies/data/row_factors.hpp"

#include "studies/data/field_number.hpp"
#include "studies/data/name_words.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace tvbeam {

namespace {

constexpr std::size_t most_texts_named = 3;

Told told_by(const std::string& name) {
    // Also with a word that says no more: sample_id, run-name; what run_type tells are series.
    static const std::set<std::string> labels{
        "seed",        "run",         "rep",     "replica", "replicate", "repeat",
        "repetition",  "sample",      "trial",   "batch",   "attempt",   "draw",
        "realization", "realisation", "machine", "host",    "hostname"};
    static const std::set<std::string> of_labels{"id",    "name", "no",     "nr",
                                                 "index", "num",  "number", "n"};
    static const std::set<std::string> times{"commit", "date", "day", "revision", "sha", "version"};
    // Also as a part of a name: newton_iterations, wall_time.
    static const std::set<std::string> outcomes{
        "seconds", "sec",        "cpu",  "wall",    "walltime", "runtime",
        "elapsed", "iterations", "iter", "its",     "niter",    "eoc",
        "verdict", "status",     "note", "comment", "remark",   "converged"};
    auto words = words_in(name);
    const auto is_one_of = [](const std::set<std::string>& these) {
        return [&these](const std::string& word) { return these.contains(word); };
    };
    if (std::ranges::any_of(words, is_one_of(outcomes)))
        return Told::outcome;
    if (std::ranges::any_of(words, is_one_of(times)))
        return Told::times;
    const bool is_label =
        std::ranges::any_of(words, is_one_of(labels)) || boost::algorithm::iequals(name, "id");
    if (words.size() > 1) // the whole of sampleId
        std::erase_if(words, [&](const std::string& word) {
            return std::ranges::any_of(words, [&](const std::string& part) {
                return part.size() < word.size() && word.starts_with(part);
            });
        });
    return is_label && std::ranges::all_of(words,
                                           [&](const std::string& word) {
                                               return labels.contains(word) ||
                                                      of_labels.contains(word);
                                           })
               ? Told::replicates
               : Told::series;
}

/// The records of one value of a column.
struct Group {
    std::string_view text;
    std::size_t first = 0;                ///< of the records
    std::set<std::vector<double>> widths; ///< different ones
};

std::vector<double> widths_of(const DataFile& data, std::size_t record) {
    std::vector<double> widths;
    for (const auto& width : data.widths)
        widths.push_back(width.numbers[record]);
    return widths;
}

bool has_figure(const DataFile& data, std::size_t record) {
    const auto is_finite = [&](const DataColumn& one) {
        return std::isfinite(one.numbers[record]);
    };
    return std::ranges::any_of(data.errors, is_finite) ||
           std::ranges::any_of(data.values, is_finite);
}

/// Those of two widths or more, in the order of their first records.
std::vector<Group> series_by(const UnreadColumn& column, const DataFile& data) {
    std::map<std::string, Group> groups;
    for (std::size_t i = 0; i < column.texts.size(); ++i)
        if (has_figure(data, i)) {
            const auto& number = column.numbers[i];
            auto& group = groups[number ? shortest(*number) : std::string(column.texts[i])];
            if (group.widths.empty()) {
                group.text = column.texts[i];
                group.first = i;
            }
            group.widths.insert(widths_of(data, i));
        }
    std::vector<Group> series;
    for (auto& [text, group] : groups)
        if (group.widths.size() >= 2U)
            series.push_back(std::move(group));
    std::ranges::sort(series, {}, &Group::first);
    return series;
}

bool has_equal_widths(const DataFile& data) {
    std::set<std::vector<double>> seen;
    for (std::size_t i = 0; i < data.widths.front().numbers.size(); ++i)
        if (has_figure(data, i) && !seen.insert(widths_of(data, i)).second)
            return true;
    return false;
}

/// Says which values of a column, of which one has several rows, are read as one series.
void name_merged(const UnreadColumn& column, DataFile& data) {
    std::set<std::string_view> texts;
    std::vector<std::string> named;
    std::size_t rows = 0;
    for (std::size_t i = 0; i < column.texts.size(); ++i)
        if (has_figure(data, i) && !column.texts[i].empty()) {
            ++rows;
            if (texts.insert(column.texts[i]).second && named.size() < most_texts_named)
                named.emplace_back(column.texts[i]);
        }
    if (texts.size() < 2 || texts.size() == rows)
        return;
    data.remarks.push_back(fmt::format(
        "rows of several {} are read as {}: {}{}; one alone with --where '{}=…'", column.name,
        column.told == Told::replicates && has_equal_widths(data) ? "replicates" : "one series",
        boost::algorithm::join(named, ", "), texts.size() == named.size() ? "" : ", …",
        column.name));
}

/// Whether each width of both takes values in a range of some length in common.
bool overlap(const Group& a, const Group& b) {
    for (std::size_t w = 0; w < a.widths.begin()->size(); ++w) {
        const auto by_width = [&](const auto& one, const auto& other) { return one[w] < other[w]; };
        const auto [a_least, a_most] = std::ranges::minmax_element(a.widths, by_width);
        const auto [b_least, b_most] = std::ranges::minmax_element(b.widths, by_width);
        const double least = std::max((*a_least)[w], (*b_least)[w]);
        const double most = std::min((*a_most)[w], (*b_most)[w]);
        const bool is_refined = (*a_least)[w] < (*a_most)[w] || (*b_least)[w] < (*b_most)[w];
        if (is_refined ? !(least < most) : least != most)
            return false;
    }
    return true;
}

/// Whether a group refines all that the data refine, as a series by itself does; the rows of one
/// mesh on a grid do not.
bool is_ladder(const Group& group, const DataFile& data) {
    for (std::size_t w = 0; w < data.widths.size(); ++w) {
        const auto& all = data.widths[w].numbers;
        const bool varies = std::ranges::adjacent_find(all, std::not_equal_to<>()) != all.end();
        const double first = (*group.widths.begin())[w];
        if (varies && std::ranges::all_of(group.widths, [&](const std::vector<double>& widths) {
                return widths[w] == first;
            }))
            return false;
    }
    return true;
}

/// At two widths alike both have rows: these are no replicates. Else by what is likely: numbers
/// that change once along the widths are what a run shows, texts that do are series.
bool are_series(const Group& a, const Group& b, bool is_number, bool is_of_times,
                const DataFile& data) {
    constexpr std::ptrdiff_t alike = 2;
    if (std::ranges::count_if(
            a.widths, [&](const auto& widths) { return b.widths.contains(widths); }) >= alike)
        return true;
    constexpr std::size_t of_numbers = 3;
    if (is_number)
        return a.widths.size() >= of_numbers && b.widths.size() >= of_numbers && overlap(a, b);
    return overlap(a, b) || (!is_of_times && is_ladder(a, data) && is_ladder(b, data));
}

} // namespace

bool RowCondition::holds_for(std::string_view field, char separator) {
    if (seen.size() < most_texts_named && std::ranges::find(seen, field) == seen.end())
        seen.emplace_back(field);
    if (text == "*" || field == text)
        return true;
    const auto number = number_of(field, separator);
    return number && number == number_of(text, separator);
}

std::vector<RowCondition> conditions_of(const ColumnNames& names,
                                        const std::vector<std::string>& where) {
    std::vector<RowCondition> conditions;
    for (const auto& one : where) {
        auto equals = one.find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError(names.place, "cannot be asked for rows where '" + one +
                                              "'; write it as COLUMN=TEXT, e.g. scheme=Euler");
        for (auto at = equals; at != std::string::npos; at = one.find('=', at + 1))
            if (names.find(boost::algorithm::trim_copy(one.substr(0, at)))) {
                equals = at; // that of a name belongs to it
                break;
            }
        const auto name = boost::algorithm::trim_copy(one.substr(0, equals));
        const auto column = names.find(name);
        if (!column)
            throw InputError(names.place,
                             fmt::format("no column '{}' for --where '{}' among {}", name, one,
                                         boost::algorithm::join(names.all, ", ")));
        if (std::ranges::find(conditions, *column, &RowCondition::column) != conditions.end())
            throw InputError(names.place, "is asked for rows by column " + name +
                                              " twice; one text each can hold");
        conditions.push_back(
            {*column, names.all[*column], boost::algorithm::trim_copy(one.substr(equals + 1))});
    }
    return conditions;
}

std::vector<std::string> chosen_by(const std::vector<RowCondition>& conditions, char separator) {
    std::vector<std::string> chosen;
    for (const auto& condition : conditions) {
        if (condition.text == "*")
            continue;
        const auto number = number_of(condition.text, separator);
        chosen.push_back(condition.name + "=" +
                         (number && std::isfinite(*number) ? shortest(*number) : condition.text));
    }
    std::ranges::sort(chosen);
    return chosen;
}

void require_records(DataFile& data, const Place& names,
                     const std::vector<RowCondition>& conditions) {
    const bool has_none = data.widths.front().numbers.empty();
    if (has_none && (conditions.empty() || conditions.front().seen.empty()))
        throw InputError({data.name}, "has no records below its line of names");
    std::vector<std::string> asked;
    std::vector<std::string> there;
    for (const auto& condition : conditions) {
        asked.push_back(condition.name + " = " + condition.text);
        there.push_back(boost::algorithm::join(condition.seen, ", ") +
                        (condition.seen.size() == most_texts_named ? ", …" : ""));
        data.remarks.push_back(condition.text == "*"
                                   ? "rows of every " + condition.name + " are taken together"
                                   : "only rows where " + asked.back());
    }
    if (has_none)
        throw InputError(names,
                         "has no row where " + boost::algorithm::join(asked, " and ") +
                             (asked.size() == 1 ? "; the column has " : "; the columns have ") +
                             boost::algorithm::join(there, " and "));
}

std::vector<UnreadColumn> unread_columns(const ColumnNames& names,
                                         const std::vector<ColumnUse>& uses,
                                         const std::vector<RowCondition>& conditions) {
    std::vector<UnreadColumn> columns;
    for (std::size_t column = 0; column < names.all.size(); ++column) {
        const auto is_it = [&](const auto& one) { return one.column == column; };
        const Told told = told_by(names.all[column]);
        if (std::ranges::none_of(uses, is_it) && std::ranges::none_of(conditions, is_it) &&
            told != Told::outcome)
            columns.push_back({.column = column, .name = names.all[column], .told = told});
    }
    return columns;
}

void require_one_series(DataFile& data, const Place& names,
                        const std::vector<UnreadColumn>& columns) {
    // Of very many values the first show as much as all, and all pairs of them would take minutes.
    constexpr std::size_t most_compared = 200;
    for (const auto& column : columns) {
        if (column.told == Told::replicates) {
            name_merged(column, data);
            continue;
        }
        auto series = series_by(column, data);
        series.resize(std::min(series.size(), most_compared));
        bool is_number = true;
        for (std::size_t i = 0; i < column.texts.size(); ++i)
            is_number = is_number && (column.texts[i].empty() || column.numbers[i]);
        for (std::size_t i = 0; i < series.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) {
                if (!are_series(series[k], series[i], is_number, column.told == Told::times, data))
                    continue;
                throw InputError(
                    names,
                    fmt::format("has rows of several series: column {0} tells '{1:.40}' from "
                                "'{2:.40}'. Take one with --where '{0}={1}', in a scene where = "
                                "[\"{0}={1}\"]; where all are of one series, --where '{0}=*' "
                                "says so",
                                column.name, series[k].text, series[i].text));
            }
        if (!is_number)
            name_merged(column, data);
    }
}

} // namespace tvbeam
