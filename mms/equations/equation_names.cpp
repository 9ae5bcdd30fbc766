#include "mms/equations/equation_names.hpp"

#include "mms/expression/algebra.hpp"
#include "mms/text/characters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tvbeam {

namespace {

constexpr std::size_t longest_name = 40;

bool is_among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void require_identifier(const NamedEntries& named) {
    const std::string& name = named.name;
    const bool fits = !name.empty() && is_letter(name.front()) && name.size() <= longest_name &&
                      std::all_of(name.begin(), name.end(),
                                  [](char c) { return is_letter(c) || is_digit(c) || c == '_'; }) &&
                      name.back() != '_';
    if (!fits)
        throw InputError(named.place, "'" + name +
                                          "' is not a name: at most 40 letters, digits and _, a "
                                          "letter first, no _ last");
    if (name == "pi" || name == "identity" || name == "sources" ||
        is_among(coordinate_names(), name) || is_among(function_names(), name) ||
        is_among(operator_names(), name))
        throw InputError(named.place, "'" + name + "' hides a known name; call it something else");
}

/// "a derivative of u", if the name reads as something that is made of another; or nothing.
std::string reading(const std::string& name, const std::map<std::string, Place>& others) {
    const std::size_t at = name.rfind('_');
    if (at == std::string::npos)
        return {};
    const std::string stem = name.substr(0, at);
    const std::string end = name.substr(at + 1);
    if (end == "exact" || end == "initial")
        return "the function of " + stem;
    if (!end.empty() && end.find_first_not_of("xyzt") == std::string::npos && others.contains(stem))
        return "a derivative of " + stem;
    return {};
}

} // namespace

const std::vector<std::string>& coordinate_names() {
    static const std::vector<std::string> names = {"x", "y", "z", "t"};
    return names;
}

const std::vector<std::string>& operator_names() {
    static const std::vector<std::string> names = {"diff",    "grad",  "div",      "curl",
                                                   "laplace", "dot",   "inner",    "outer",
                                                   "sym",     "trace", "transpose"};
    return names;
}

std::vector<std::string> component_names(const std::string& name, std::size_t count) {
    if (count == 1)
        return {name};
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= count; ++i)
        names.push_back(name + std::to_string(i));
    return names;
}

void require_names(const EquationSystem& system) {
    std::map<std::string, Place> given;
    const auto add = [&](const std::string& name, const Place& place) {
        const auto [entry, is_new] = given.try_emplace(name, place);
        if (!is_new)
            throw InputError(place, "'" + name + "' is the name of something at line " +
                                        std::to_string(entry->second.line) +
                                        " as well; call one of them something else");
    };
    std::vector<const NamedEntries*> all;
    for (const auto* block :
         {&system.parameters, &system.unknowns, &system.definitions, &system.equations})
        for (const auto& named : *block)
            all.push_back(&named);
    for (const auto& entry : system.boundary)
        all.push_back(&entry.value);
    for (const NamedEntries* named : all) {
        require_identifier(*named);
        add(named->name, named->place);
    }
    for (const auto& named : system.initial)
        require_identifier(named);
    // Components of equations may come of one text; their number is known when it is derived.
    for (const NamedEntries* named : all)
        if (named->entries.size() > 1)
            for (const auto& component : component_names(named->name, named->entries.size()))
                add(component, named->place);
    for (const auto& [name, place] : given)
        if (const std::string other = reading(name, given); !other.empty())
            throw InputError(place,
                             fmt::format("'{}' reads as {}; call it something else", name, other));
}

} // namespace tvbeam
