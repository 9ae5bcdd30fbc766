#include "studies/external/solver_block.hpp"

#include "mms/text/characters.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "mms/text/visible_text.hpp"
#include "studies/external/digest.hpp"
#include "studies/external/solution_formulas.hpp"
#include "studies/scene/shipped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>

namespace tvbeam {

namespace {

constexpr std::uintmax_t largest_template = std::uintmax_t{16} << 20U;
/// That are filled in besides the parameters.
constexpr std::array<const char*, 6> own_placeholders{"elements", "h",          "dt",
                                                      "steps",    "final_time", "level"};

bool is_name(const std::string& text) {
    return !text.empty() && !is_digit(text.front()) &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

/// The system takes a text up to its first character of code 0: what follows would be lost unsaid.
void require_whole(const TableReader& table, const std::string& key, const std::string& text,
                   std::optional<std::size_t> element = std::nullopt) {
    constexpr const char* what = " holds a character of code 0, which ends a text; leave it out";
    if (text.find('\0') != std::string::npos)
        throw element ? table.error(key, what, *element) : table.error(key, what);
}

std::vector<Template> read_command(TableReader& table) {
    const auto words = table.texts("command");
    if (!words || words->empty())
        throw table.error("command", " is missing or empty; give the program and its arguments as "
                                     "a list: [\"python3\", \"heat.py\", \"{elements}\"]");
    std::vector<Template> command;
    for (std::size_t i = 0; i < words->size(); ++i) {
        require_whole(table, "command", (*words)[i], i);
        command.push_back({(*words)[i], table.place("command", i)});
    }
    if (command.front().text.empty())
        throw table.error("command", " begins with nothing; its first word is the program", 0);
    return command;
}

std::string text_in(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

SolverFile read_file(const TableReader& table, std::size_t i, const std::string& name,
                     const std::filesystem::path& folder) {
    SolverFile file;
    file.source = folder / name;
    std::error_code error;
    if (!std::filesystem::exists(file.source, error))
        throw table.error("files",
                          " names '" + name + "', and there is no file " + file.source.string(), i);
    if (!std::filesystem::is_regular_file(file.source, error))
        throw table.error("files", " names '" + name + "', which is no file; name the files in it",
                          i);
    if (std::ifstream readable(file.source); !readable)
        throw table.error("files", " names '" + name + "', which cannot be read", i);
    // Where a file lies outside of the scene's folder, its name alone is kept.
    const auto within = std::filesystem::path(name).lexically_normal();
    file.name = within.is_absolute() || within.begin()->string() == ".."
                    ? within.filename().string()
                    : within.string();
    if (file.name.ends_with(".in") && file.name.size() > 3) {
        if (std::filesystem::file_size(file.source, error) > largest_template)
            throw table.error("files", " names the template '" + name + "' of more than 16 MiB", i);
        file.name.resize(file.name.size() - 3);
        file.contents = Template{text_in(file.source), {file.source.string()}, true};
    }
    return file;
}

using FileNames = std::set<std::string>; ///< in the directory of a run

/// The name among them beside which this one cannot stand in a directory: it is the same, or one is
/// a folder on the way to the other.
std::optional<std::string> in_the_way(const FileNames& names, const std::string& name) {
    for (std::filesystem::path part = name; !part.empty(); part = part.parent_path())
        if (names.contains(part.string()))
            return part.string();
    const auto within = names.lower_bound(name + "/");
    return within != names.end() && within->starts_with(name + "/") ? std::optional(*within)
                                                                    : std::nullopt;
}

std::vector<SolverFile> read_files(TableReader& table, const std::filesystem::path& folder,
                                   FileNames& names) {
    std::vector<SolverFile> files;
    const auto given = table.texts("files").value_or(std::vector<std::string>{});
    for (std::size_t i = 0; i < given.size(); ++i) {
        require_whole(table, "files", given[i], i);
        files.push_back(read_file(table, i, given[i], folder));
        const std::string& name = files.back().name;
        if (const auto other = in_the_way(names, name))
            throw table.error("files",
                              *other == name
                                  ? " holds two that become '" + name +
                                        "' in the directory of a run; remove one"
                                  : " holds '" + *other + "' and '" + name +
                                        "', of which one would be a folder with the other in it; "
                                        "rename one",
                              i);
        names.insert(name);
    }
    return files;
}

/// What a run writes stands in its own directory. A copy of it from an earlier run would pass for
/// what a program has written that has written nothing.
std::string read_file_name(const TableReader& table, const std::string& key,
                           const std::string& name, const FileNames& files) {
    require_whole(table, key, name);
    const std::filesystem::path path = name;
    if (path.extension() != ".json" && path.extension() != ".csv")
        throw table.error(key, " is '" + name +
                                   "'; it must be a file that ends in .json or .csv, or a table of "
                                   "regular expressions: { L2 = 'L2 error = (\\S+)' }");
    if (path.is_absolute() || path.lexically_normal().begin()->string() == "..")
        throw table.error(key, " is '" + name +
                                   "'; it must be a file in the directory of the run, to which "
                                   "its path is relative");
    if (const auto copied = in_the_way(files, path.lexically_normal().string()))
        throw table.error(key, " is '" + name +
                                   "', which the program writes, and solver.files "
                                   "copies '" +
                                   *copied +
                                   "' to its place before each run; take that out of solver.files");
    return name;
}

FigureSource read_source(TableReader& table, const std::string& key, const FileNames& files) {
    FigureSource source;
    if (table.is_string(key)) {
        source.file = read_file_name(table, key, *table.text(key), files);
        return source;
    }
    auto patterns = table.table(key);
    if (!patterns)
        return source;
    for (const auto& name : patterns->unread()) {
        if (!is_name(name))
            throw InputError(patterns->place_of_key(name),
                             "'" + name +
                                 "' is no name for a number; it must be of letters, "
                                 "digits and _, no digit first");
        if (const auto taken = column_of_tables(name, {}))
            throw InputError(patterns->place_of_key(name), *taken);
        source.patterns.emplace_back(name, *patterns->text(name), patterns->place(name));
    }
    if (source.patterns.empty())
        throw table.error(key, " is empty; name a number: { L2 = 'L2 error = (\\S+)' }");
    return source;
}

/// Tables have the orders of a number beside it, and what is predicted of it.
void require_other_columns(TableReader& table, const std::vector<Measure>& measures) {
    for (const auto& measure : measures)
        if (const auto taken = column_of_tables(measure.name, measures))
            throw table.error(measure.is_value ? "values" : "errors",
                              " name " + measure.name + ", and " + *taken);
}

Parameters read_parameters(TableReader& table, const Parameters* known) {
    Parameters parameters = known != nullptr ? *known : Parameters();
    auto given = table.table("parameters");
    if (!given)
        return parameters;
    for (const auto& name : given->unread()) {
        if (!is_name(name))
            throw InputError(given->place_of_key(name),
                             "'" + name +
                                 "' is no name for a parameter; it must be of letters, "
                                 "digits and _, no digit first");
        if (std::find(own_placeholders.begin(), own_placeholders.end(), name) !=
            own_placeholders.end())
            throw InputError(given->place_of_key(name),
                             "{" + name +
                                 "} is filled in by the studies; give the parameter "
                                 "another name");
        if (known != nullptr && !known->contains(name)) {
            std::vector<std::string> names;
            for (const auto& [own, value] : *known)
                names.push_back(own);
            throw InputError(given->place_of_key(name), "[solver.parameters] has no " + name +
                                                            did_you_mean(name, names) +
                                                            "; give its usual value there");
        }
        parameters[name] = *given->word(name);
        require_whole(*given, name, parameters[name]);
    }
    return parameters;
}

std::map<std::string, std::string> read_environment(TableReader& table) {
    std::map<std::string, std::string> environment;
    if (auto given = table.table("environment"))
        for (const auto& name : given->unread()) {
            if (name.empty() || name.find_first_of(std::string_view("=\0", 2)) != std::string::npos)
                throw InputError(given->place_of_key(name),
                                 "'" + visible(name) + "' is no name of a variable");
            environment[name] = *given->word(name);
            require_whole(*given, name, environment[name]);
        }
    return environment;
}

/// Puts the formulas of a file of equations into the command and the templates.
void fill_in_solution(TableReader& table, SolverBlock& solver, bool formulas_wanted) {
    const auto name = table.text("solution");
    const auto language = table.choice("language", code_language_names());
    if (!name) {
        if (language)
            throw table.error("language", " is given, and no solution is; it says in what language "
                                          "the formulas of solver.solution are written");
        return;
    }
    if (!language)
        throw table.error("solution", " needs solver.language, in which its formulas are written: "
                                      "language = \"python\"");
    if (!formulas_wanted)
        return;
    SolutionFormulas formulas(
        find_file(Shipped::equations, *name, solver.folder, table.place("solution")),
        *code_language(code_language_names()[*language]));
    for (Template& word : solver.command)
        word = formulas.filled(word);
    for (SolverFile& file : solver.files)
        if (file.contents)
            file.contents = formulas.filled(*file.contents);
    for (const auto& parameter : formulas.parameters())
        solver.of_solution[parameter.name] = parameter.value;
    if (!formulas.used())
        throw table.error("solution", " is used by nothing; write {source.NAME}, {exact.NAME} or "
                                      "{functions} into a file NAME.in, or leave it out");
}

/// A parameter of the solution is a number in what was derived from it: the solver must not be
/// given another one under its name.
void require_those_of_solution(const SolverBlock& solver, const Parameters& parameters,
                               const Place& place) {
    for (const auto& [name, value] : parameters) {
        const auto own = solver.of_solution.find(name);
        if (own == solver.of_solution.end())
            continue;
        double number = 0.0;
        const char* const end = value.data() + value.size();
        const auto [read_to, error] = std::from_chars(value.data(), end, number);
        if (read_to != end || error != std::errc()) // a text, of which the solver alone knows
            continue;
        constexpr double last_digits = 1e-12; // as of 1/3 written out
        if (!(std::abs(number - own->second) <= last_digits * std::abs(own->second)))
            throw InputError(
                place,
                fmt::format("parameter {} is {}, and {} in the solution, whose sources are derived "
                            "with that; give both one value, or one of them another name",
                            name, value, message_text(own->second)));
    }
}

std::string text_of(const Parameters& parameters) {
    std::string text;
    for (const auto& [name, value] : parameters)
        text.append(text.empty() ? "" : ", ").append(name).append(" = ").append(value);
    return text;
}

} // namespace

SolverBlock read_solver(TableReader table, const std::filesystem::path& folder, bool formulas) {
    SolverBlock solver;
    solver.folder = folder;
    solver.command = read_command(table);
    FileNames files;
    solver.files = read_files(table, folder, files);
    solver.errors = read_source(table, "errors", files);
    solver.values = read_source(table, "values", files);
    require_other_columns(table, solver_keys(solver).measures);
    for (const auto& pattern : solver.values.patterns)
        if (solver.errors.pattern(pattern.name) != nullptr)
            throw table.error("values", " has " + pattern.name +
                                            ", which is an error as well; give it another name");
    if (const auto text = table.text("seconds"))
        solver.seconds.emplace("seconds", *text, table.place("seconds"));
    solver.timeout = table.number("timeout");
    if (solver.timeout && !(*solver.timeout > 0.0))
        throw table.error("timeout", " is " + message_text(*solver.timeout) +
                                         "; it must be > 0, the seconds that a run may take");
    solver.environment = read_environment(table);
    solver.parameters = read_parameters(table, nullptr);
    fill_in_solution(table, solver, formulas);
    require_those_of_solution(solver, solver.parameters, table.place("parameters"));
    table.finish();
    return solver;
}

void note_contents(SolverBlock& solver) {
    for (SolverFile& file : solver.files)
        if (!file.contents)
            file.digest = digest(file.source);
}

Method method_of(const SolverBlock& solver, const Parameters& parameters) {
    std::string words = command_text(solver);
    if (!parameters.empty())
        words += " with " + text_of(parameters);
    return {.scheme = parameters,
            .name = parameters.empty() ? "solver" : text_of(parameters),
            .words = words,
            .cost = 1.0,
            .iterations = ""};
}

const Parameters& parameters_of(const Method& method) {
    return std::any_cast<const Parameters&>(method.scheme);
}

SolverKeys solver_keys(const SolverBlock& solver) {
    SolverKeys keys;
    for (const bool is_value : {false, true}) {
        const FigureSource& source = is_value ? solver.values : solver.errors;
        for (const auto& pattern : source.patterns)
            keys.measures.push_back(
                {.name = pattern.name, .words = pattern.name, .is_value = is_value});
        (is_value ? keys.any_value : keys.any_error) = source.is_file();
    }
    keys.any_widths = true;
    keys.read_method = [&solver](TableReader& table) {
        const Parameters parameters = read_parameters(table, &solver.parameters);
        require_those_of_solution(solver, parameters, table.place("parameters"));
        return method_of(solver, parameters);
    };
    return keys;
}

std::string command_text(const SolverBlock& solver) {
    std::string text;
    for (const auto& word : solver.command)
        text += (text.empty() ? "" : " ") + word.text;
    return text;
}

} // namespace tvbeam
