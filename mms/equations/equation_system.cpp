#include "mms/equations/equation_system.hpp"

#include "mms/equations/equation_names.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/text/toml_reader.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace tvbeam {

namespace {

constexpr std::size_t most_names = 100; ///< in a block
constexpr std::size_t most_components = 9;

NamedEntries read_entries(TableReader& table, const std::string& name) {
    NamedEntries named{name, table.place_of_key(name), *table.expressions(name)};
    if (named.entries.empty() || named.entries.size() > most_components)
        throw table.error(name, " has " + std::to_string(named.entries.size()) +
                                    " components; a vector has 1 to " +
                                    std::to_string(most_components));
    return named;
}

/// The keys in the order of the file.
std::vector<std::string> keys_of(const TableReader& root, std::string_view block,
                                 const TableReader& table) {
    std::vector<std::string> names = table.unread();
    if (names.size() > most_names)
        throw root.error(block, " holds " + std::to_string(names.size()) + " names; at most " +
                                    std::to_string(most_names) + " are allowed");
    const auto place = [&](const std::string& name) {
        const Place at = table.place_of_key(name);
        return std::pair{at.line, at.column};
    };
    std::sort(names.begin(), names.end(),
              [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
    return names;
}

std::vector<NamedEntries> read_block(TableReader& root, std::string_view block) {
    std::vector<NamedEntries> result;
    auto table = root.table(block);
    if (!table)
        return result;
    for (const auto& name : keys_of(root, block, *table))
        result.push_back(read_entries(*table, name));
    return result;
}

/// "x = 1": the coordinate, and where its '=' stands.
void read_plane(BoundaryEntry& entry, const SourceText& on) {
    const std::string& text = on.text();
    const auto wrong = [&](std::size_t at) {
        return InputError(on.at(at), "on is '" + text +
                                         "'; it must be a plane of one coordinate, as \"x = 1\"");
    };
    const std::size_t first = text.find_first_not_of(" \t");
    const std::size_t equals = text.find('=');
    if (first == std::string::npos || equals == std::string::npos)
        throw wrong(0);
    const std::string variable =
        text.substr(first, text.find_last_not_of(" \t", equals - 1) + 1 - first);
    if (variable != "x" && variable != "y" && variable != "z")
        throw wrong(first);
    entry.variable = variable;
    entry.position = SourceText(text.substr(equals + 1), on.at(equals + 1));
    for (const auto& coordinate : coordinate_names())
        if (coordinate != "t" && first_use(entry.position, coordinate))
            throw wrong(first);
}

std::vector<BoundaryEntry> read_boundary(TableReader& root) {
    std::vector<BoundaryEntry> result;
    auto table = root.table("boundary");
    if (!table)
        return result;
    for (const auto& name : keys_of(root, "boundary", *table)) {
        BoundaryEntry entry;
        if (!table->is_table(name)) {
            entry.value = read_entries(*table, name);
            result.push_back(entry);
            continue;
        }
        auto inner = *table->table(name);
        const auto on = inner.expression("on");
        if (!inner.has("value"))
            throw table->error(name, " has no value; give { on = \"x = 1\", value = \"…\" }");
        entry.value = read_entries(inner, "value");
        entry.value.name = name;
        entry.value.place = table->place_of_key(name);
        inner.finish();
        if (on)
            read_plane(entry, *on);
        result.push_back(entry);
    }
    return result;
}

std::map<std::string, DomainInterval> read_domain(TableReader& root) {
    std::map<std::string, DomainInterval> domain;
    for (const auto& coordinate : coordinate_names())
        domain[coordinate] = {};
    if (auto table = root.table("domain")) {
        for (const auto& coordinate : coordinate_names())
            if (const auto band = table->band(coordinate, ""))
                domain[coordinate] = {band->lowest, band->highest};
        table->finish();
    }
    return domain;
}

std::vector<const NamedEntries*> all_entries(const EquationSystem& system) {
    std::vector<const NamedEntries*> all;
    for (const auto* block :
         {&system.unknowns, &system.definitions, &system.equations, &system.initial})
        for (const auto& named : *block)
            all.push_back(&named);
    for (const auto& entry : system.boundary)
        all.push_back(&entry.value);
    return all;
}

/// The coordinates that the file names, and the dimension that they make.
void find_coordinates(EquationSystem& system, TableReader& root) {
    std::set<std::string> named;
    for (const NamedEntries* one : all_entries(system))
        for (const SourceText& entry : one->entries)
            for (const auto& coordinate : coordinate_names())
                if (first_use(entry, coordinate))
                    named.insert(coordinate);
    for (const auto& entry : system.boundary)
        if (!entry.variable.empty())
            named.insert(entry.variable);
    for (const auto& coordinate : coordinate_names())
        if (named.contains(coordinate))
            system.coordinates.push_back(coordinate);
    system.dimension = named.contains("z") ? 3 : named.contains("y") ? 2 : 1;
    if (const auto dimension = root.integer("dimension")) {
        if (*dimension < system.dimension || *dimension > 3)
            throw root.error("dimension", " is " + std::to_string(*dimension) + "; it must be " +
                                              std::to_string(system.dimension) +
                                              " to 3, as the coordinates of the file ask");
        system.dimension = static_cast<int>(*dimension);
    }
}

EquationSystem system_in(const TomlDocument& document) {
    TableReader root(document, document.table, "");
    EquationSystem system;
    system.file = document.file;
    system.name = root.text("name").value_or(std::filesystem::path(document.file).stem().string());
    if (system.name.empty())
        throw InputError(root.has("name") ? root.place("name") : Place{document.file},
                         "name is empty; give the equations a name");
    system.source = root.text("source").value_or("");
    system.purpose = root.text("purpose").value_or("");
    system.parameters = read_block(root, "parameters");
    for (const auto& parameter : system.parameters)
        if (parameter.entries.size() > 1)
            throw InputError(parameter.place, "parameter " + parameter.name +
                                                  " is a vector; give a number for each component");
    system.unknowns = read_block(root, "unknowns");
    system.definitions = read_block(root, "definitions");
    system.equations = read_block(root, "equations");
    system.boundary = read_boundary(root);
    system.initial = read_block(root, "initial");
    system.domain = read_domain(root);
    find_coordinates(system, root);
    root.finish();
    for (const auto* block : {"unknowns", "equations"})
        if (!root.has(block) ||
            (std::string_view(block) == "unknowns" ? system.unknowns : system.equations).empty())
            throw InputError(root.has(block) ? root.place(block) : Place{document.file},
                             std::string("[") + block +
                                 "] is missing or empty; a file of "
                                 "equations has [unknowns], the exact "
                                 "solution, and [equations]");
    require_names(system);
    return system;
}

} // namespace

bool is_equation_system(const std::filesystem::path& file) {
    const toml::table table = read_toml(file.string()).table;
    return table.contains("equations") || table.contains("unknowns");
}

EquationSystem read_equation_system(const std::filesystem::path& file) {
    return system_in(read_toml(file.string()));
}

EquationSystem parse_equation_system(std::string_view document, const std::string& file) {
    return system_in(parse_toml(std::string(document), file));
}

} // namespace tvbeam
