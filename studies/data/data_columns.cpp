#include "studies/data/data_columns.hpp"

#include "mms/text/nearest_name.hpp"
#include "studies/data/name_words.hpp"
#include "studies/text/number_text.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>
#include <utility>

namespace tvbeam {

namespace {

/// What a name says of the numbers in its column; level: how often a mesh was refined.
enum class Meaning { width, count, level, logarithm, unsaid };

bool has_one_of(const std::set<std::string>& these, const std::set<std::string>& words) {
    return std::ranges::any_of(these,
                               [&](const std::string& word) { return words.contains(word); });
}

bool is_logarithm(const std::set<std::string>& words) {
    return has_one_of({"log", "log2", "log10", "ln", "lg", "logn", "log2n", "log10n", "logh",
                       "log2h", "log10h", "lnn", "lnh"},
                      words);
}

Meaning meaning_of_words(const std::set<std::string>& words) {
    static const std::set<std::string> numbers{"n", "num", "number", "count", "counts"};
    static const std::set<std::string> things{
        "elements", "elems",  "elem",     "nelem",   "nelems",     "nelements", "nele",
        "nelx",     "nely",   "nelz",     "nel",     "ne",         "cells",     "ncell",
        "ncells",   "dofs",   "dof",      "ndof",    "ndofs",      "freedom",   "nodes",
        "nnode",    "nnodes", "points",   "npoints", "pts",        "npts",      "gridpoints",
        "ngrid",    "ntri",   "tets",     "faces",   "triangles",  "unknowns",  "vertices",
        "nx",       "ny",     "nz",       "nr",      "intervals",  "steps",     "nsteps",
        "nstep",    "nt",     "substeps", "quads",   "tetrahedra", "timesteps"};
    static const std::set<std::string> widths{
        "h",    "hx",       "hy",       "hz",  "hmax",  "hmin",    "dx",   "dy",
        "dz",   "dr",       "dt",       "tau", "width", "spacing", "step", "delta",
        "diam", "diameter", "timestep", "Δx",  "Δt",    "Δ",       "τ"};
    static const std::set<std::string> levels{"level", "levels", "lvl",        "ref",
                                              "refs",  "refine", "refinement", "refinements"};
    const bool is_size = words.contains("size");
    if (is_size && words.size() == 1)
        return Meaning::count;
    const bool says_width = has_one_of(widths, words) ||
                            (is_size && has_one_of({"mesh", "cell", "element", "step"}, words));
    if (has_one_of(levels, words) && !says_width)
        return Meaning::level;
    const bool says_count = has_one_of(numbers, words) || has_one_of(things, words);
    return says_width == says_count ? Meaning::unsaid
           : says_width             ? Meaning::width
                                    : Meaning::count;
}

/// By the words of a name: n and dofs of n_dofs and nDofs, dofs of DoFs; what stands behind a sign
/// of equality or in brackets explains it. Of n things in a domain of dimension d, h = n^(-1/d); of
/// n steps up to the time 1, Δt = 1/n.
Meaning meaning_of(const std::string& whole) {
    std::string name = whole.substr(0, whole.find_first_of("=([", 1));
    bool is_inverse = false;
    if (name.starts_with("1/")) {
        is_inverse = true;
        name.erase(0, 2);
    }
    if (name.find_first_of("/^*") != std::string::npos)
        return Meaning::unsaid;
    auto words = words_in(name);
    if (is_logarithm(words))
        return Meaning::logarithm;
    for (const char* inverse : {"inv", "inverse", "reciprocal"})
        is_inverse = words.erase(inverse) > 0 || is_inverse;
    const Meaning meaning = meaning_of_words(words);
    return !is_inverse                 ? meaning
           : meaning == Meaning::width ? Meaning::count
           : meaning == Meaning::count ? Meaning::width
                                       : meaning;
}

void require_no_logarithm(const ColumnNames& names, const std::string& name, Meaning meaning) {
    if (meaning == Meaning::logarithm)
        throw InputError(names.place,
                         "column " + name +
                             " is a logarithm; give a column of what it is of, or another name "
                             "where it is none");
}

/// The widths that a choice names, or those that need no name.
void choose_widths(const ColumnNames& names, const DataChoice& choice, DataFile& data,
                   std::vector<ColumnUse>& uses) {
    std::vector<std::string> sizes = names.apart(choice.sizes);
    if (sizes.empty())
        for (const char* name : {"h", "elements"})
            if (sizes.empty() && names.find(name))
                sizes.emplace_back(name);
    for (const auto& size : sizes) {
        ColumnUse use{names.need(size, "--size"), true};
        const Meaning meaning = meaning_of(size);
        if (meaning == Meaning::level)
            throw InputError(names.place, "column " + size +
                                              " numbers levels of refinement, which have widths as "
                                              "h = 2^-level; give a column of these");
        require_no_logarithm(names, size, meaning);
        if (choice.dimension && meaning == Meaning::width)
            throw InputError(names.place, "column " + size +
                                              " is a width already; --dimension is for numbers of "
                                              "cells or unknowns");
        const bool counts = choice.dimension || meaning == Meaning::count;
        use.is_unsaid = !counts && meaning == Meaning::unsaid;
        use.may_count = !counts && has_one_of({"size", "step", "spacing"}, words_in(size));
        const std::string name = !counts ? size : sizes.size() == 1 ? "h" : "h_" + size;
        if (counts) {
            const double dimension = choice.dimension.value_or(1.0);
            use.power = -1.0 / dimension;
            const std::string number =
                size.find('/') == std::string::npos ? size : "(" + size + ")";
            data.remarks.push_back(
                name + " = " +
                (dimension == 1.0 ? "1/" + number : number + "^(-1/" + shortest(dimension) + ")") +
                (choice.dimension || size == "elements"
                     ? ""
                     : ": dimension 1 was assumed; --dimension D says another"));
        }
        data.widths.push_back({name, {}});
        uses.push_back(use);
    }
    auto step = names.find("dt");
    if (choice.step)
        step = names.need(*choice.step, "--step");
    else if (step && names.blank.contains(*step))
        step.reset();
    if (step && std::none_of(uses.begin(), uses.end(),
                             [&](const ColumnUse& use) { return use.column == *step; })) {
        const std::string name = choice.step.value_or("dt");
        const Meaning meaning = meaning_of(name);
        require_no_logarithm(names, name, meaning);
        const bool counts = meaning == Meaning::count;
        if (counts)
            data.remarks.push_back("dt = 1/" + name + ": the time 1 was assumed");
        data.widths.push_back({counts ? "dt" : name, {}});
        uses.push_back({*step, true, counts ? -1.0 : 1.0});
        uses.back().is_step = true;
        uses.back().is_unsaid = meaning == Meaning::unsaid || meaning == Meaning::level;
        uses.back().may_count = !counts && words_in(name).contains("step");
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
    std::vector<std::string> errors = names.apart(choice.errors);
    std::vector<std::string> values = names.apart(choice.values);
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
            const auto words = words_in(name);
            require_no_logarithm(names, name,
                                 is_logarithm(words) && words.size() > 1 ? Meaning::logarithm
                                                                         : Meaning::unsaid);
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

/// Whether each number that is new is greater than those before it.
bool appear_growing(const std::vector<double>& numbers) {
    double greatest = 0;
    std::set<double> seen;
    for (const double number : numbers)
        if (seen.insert(number).second && number < std::exchange(greatest, number))
            return false;
    return true;
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

std::vector<std::string> ColumnNames::apart(const std::vector<std::string>& texts) const {
    std::vector<std::string> names;
    for (const auto& text : texts) {
        std::vector<std::string> parts{text};
        if (!find(text))
            boost::algorithm::split(parts, text, [](char c) { return c == ','; });
        std::erase(parts, "");
        if (parts.empty())
            parts = {text};
        names.insert(names.end(), parts.begin(), parts.end());
    }
    return names;
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

void require_sizes_that_are_known(const ColumnNames& names, const std::vector<ColumnUse>& uses,
                                  DataFile& data) {
    for (const auto& use : uses) {
        if (!use.is_unsaid && !use.may_count)
            continue;
        const auto& numbers = use.target->numbers;
        if (std::ranges::adjacent_find(numbers, std::not_equal_to()) == numbers.end())
            continue; // nothing is refined
        if (!use.is_unsaid && !appear_growing(numbers))
            continue; // widths from coarse to fine
        const std::string& name = names.all[use.column];
        const std::string otherwise = fmt::format(
            fmt::runtime(use.is_step
                             ? "a name like n_{} says that it counts steps"
                             : "--dimension D says that it counts what fills a domain, as a name "
                               "like n_{} does"),
            name);
        if (std::ranges::all_of(numbers, [](double number) {
                return number >= 1.0 && std::floor(number) == number;
            }))
            throw InputError(
                names.place,
                fmt::format("column {} has whole numbers, and its name does not say whether they "
                            "are widths or count something; call it {} where they are widths; {}",
                            name, use.is_step ? "dt" : "h", otherwise));
        if (use.is_unsaid)
            data.remarks.push_back(fmt::format("{} was taken for a width; {}", name, otherwise));
    }
}

} // namespace tvbeam
