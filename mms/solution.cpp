#include "mms/solution.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/solution_expressions.hpp"
#include "mms/text/characters.hpp"
#include "mms/text/toml_reader.hpp"

#include <algorithm>

namespace tvbeam {

namespace {

// Each of them is derived from, and compared with all others.
constexpr std::size_t most_phases = 1000;
constexpr std::size_t most_parameters = 1000;

/// What a phase may say, and the top of the file for all of them.
struct Formulas {
    std::optional<SourceText> theta, u, sigma;
};

Formulas read_formulas(TableReader& table) {
    return {table.expression("theta"), table.expression("u"), table.expression("sigma")};
}

void require_free_name(const std::string& name, const Place& place) {
    const auto begins = [](char c) { return is_letter(c) || c == '_'; };
    const auto fits = [&](char c) { return begins(c) || is_digit(c); };
    if (name.empty() || !begins(name.front()) || !std::all_of(name.begin(), name.end(), fits))
        throw InputError(place, "parameter '" + name +
                                    "' is not a name: letters, digits and _ only, no digit first");
    const auto& functions = function_names();
    if (name == "pi" || model_symbol_table().contains(name) ||
        std::find(functions.begin(), functions.end(), name) != functions.end())
        throw InputError(place,
                         "parameter '" + name + "' hides a known name; call it something else" +
                             (model_symbol_table().contains(name) && name != "x" && name != "t"
                                  ? ", or leave it out: it is the beam's, and stands in the "
                                    "scene"
                                  : ""));
}

std::vector<SolutionParameter> read_parameters(TableReader& root) {
    std::vector<SolutionParameter> result;
    auto table = root.table("parameters");
    const auto names = table ? table->unread() : std::vector<std::string>();
    if (names.size() > most_parameters)
        throw root.error("parameters", " holds " + std::to_string(names.size()) +
                                           "; a solution has at most " +
                                           std::to_string(most_parameters));
    for (const auto& name : names) {
        if (name == "theta" || name == "u" || name == "sigma")
            throw InputError(table->place_of_key(name),
                             name + " stands below [parameters], which makes it a parameter; move "
                                    "it above that line, or give the parameter another name");
        require_free_name(name, table->place_of_key(name));
        result.push_back({name, *table->expression(name)});
    }
    return result;
}

/// A phase with what the top of the file says for all phases, and what its own table says; only:
/// the file has no tables of phases, and own is its top.
SolutionPhase phase_of(const TableReader& root, const Formulas& top, const TableReader& own,
                       const Formulas& inner, bool only) {
    using Formula = std::optional<SourceText> Formulas::*;
    const auto given = [&](const std::string& key, Formula formula) {
        if (top.*formula && inner.*formula)
            throw InputError(own.place_of_key(key),
                             key + " is given here and at line " +
                                 std::to_string(root.place_of_key(key).line) +
                                 " for all phases; leave one out");
        return top.*formula ? top.*formula : inner.*formula;
    };
    const auto needed = [&](const std::string& key, Formula formula) {
        const auto found = given(key, formula);
        if (!found)
            throw InputError(only ? Place{own.place().file} : own.place(),
                             key + " is missing; a solution gives theta and u" +
                                 (only ? "" : ", at the top or in every phase"));
        return *found;
    };
    SolutionPhase phase;
    phase.theta = needed("theta", &Formulas::theta);
    phase.u = needed("u", &Formulas::u);
    phase.sigma = given("sigma", &Formulas::sigma);
    return phase;
}

/// One of the tables [[phase]].
SolutionPhase read_phase(const TableReader& root, const Formulas& top, TableReader& table,
                         bool last) {
    const Formulas inner = read_formulas(table);
    const auto until = table.expression("until");
    table.finish();
    SolutionPhase phase = phase_of(root, top, table, inner, false);
    if (last && until)
        throw InputError(table.place_of_key("until"),
                         "the last phase holds for all later times; remove its until");
    if (!last && !until)
        throw InputError(table.place(), "until is missing; every phase but the last says when it "
                                        "ends");
    phase.until = until;
    return phase;
}

Solution solution_in(const TomlDocument& document) {
    TableReader root(document, document.table, "");
    Solution solution;
    solution.name =
        root.text("name").value_or(std::filesystem::path(document.file).stem().string());
    if (solution.name.empty())
        throw InputError(root.has("name") ? root.place("name") : Place{document.file},
                         "name is empty; give the solution a name");
    solution.source = root.text("source").value_or("");
    solution.purpose = root.text("purpose").value_or("");
    const Formulas top = read_formulas(root);
    solution.parameters = read_parameters(root);
    auto tables = root.tables("phase");
    for (const std::string of_beam : {"alpha", "zeta", "stops", "theta_A"})
        if (root.has(of_beam))
            throw InputError(root.place_of_key(of_beam),
                             of_beam + " is the beam's; it stands in [beam] of the scene, and "
                                       "formulas know it from there");
    root.finish();
    if (tables.size() > most_phases)
        throw root.error("phase", " holds " + std::to_string(tables.size()) +
                                      " phases; a solution has at most " +
                                      std::to_string(most_phases));
    if (tables.empty())
        solution.phases.push_back(phase_of(root, top, root, {}, true));
    for (auto& table : tables)
        solution.phases.push_back(read_phase(root, top, table, &table == &tables.back()));
    expressions_of(solution);
    return solution;
}

} // namespace

Solution parse_solution(std::string_view document, const std::string& file) {
    return solution_in(parse_toml(std::string(document), file));
}

Solution read_solution(const std::filesystem::path& path) {
    return solution_in(read_toml(path.string()));
}

} // namespace tvbeam
