#include "studies/external/solution_formulas.hpp"

#include "mms/equations/system_checks.hpp"
#include "mms/text/nearest_name.hpp"
#include "studies/text/number_text.hpp"

#include <array>
#include <vector>

namespace tvbeam {

namespace {

using Role = DerivedFunction::Role;

constexpr std::array<const char*, 5> kinds{"source.", "exact.", "boundary.", "initial.",
                                           "parameter."};

/// Whether what stands in braces is for the file of equations, and not for the studies.
bool is_formula(const std::string& name) {
    for (const char* kind : kinds)
        if (name.starts_with(kind))
            return true;
    return name == "functions";
}

std::string name_of(const DerivedFunction& function) {
    switch (function.role) {
    case Role::source:
        return "source." + function.of;
    case Role::exact:
        return "exact." + function.of;
    case Role::gradient:
        return "exact." + function.of + "_" + function.name.back();
    case Role::boundary:
        return "boundary." + function.of;
    case Role::initial:
        break;
    }
    return "initial." + function.of;
}

DerivedSystem checked(const std::filesystem::path& file) {
    DerivedSystem derived = derive_system(read_equation_system(file));
    require_exact_values(derived); // what else there is to say, `tvbeam derive` says
    return derived;
}

} // namespace

SolutionFormulas::SolutionFormulas(const std::filesystem::path& file, CodeLanguage language)
    : derived_(checked(file)), language_(language) {
    for (const auto& function : derived_.functions)
        functions_[name_of(function)] = &function;
    for (const auto& parameter : derived_.parameters)
        parameters_["parameter." + parameter.name] = parameter.value;
}

std::string SolutionFormulas::text_of(const std::string& name, const Place& place,
                                      bool is_code) const {
    if (name == "functions")
        return system_code(derived_, language_);
    if (const auto found = functions_.find(name); found != functions_.end())
        return inline_code(derived_, *found->second, language_);
    if (const auto found = parameters_.find(name); found != parameters_.end())
        return is_code ? inline_number(found->second, language_) : shortest(found->second);
    std::vector<std::string> names = {"functions"};
    for (const auto& [known, function] : functions_)
        names.push_back(known);
    for (const auto& [known, value] : parameters_)
        names.push_back(known);
    std::string list;
    for (const auto& known : names)
        list += (list.empty() ? "" : ", ") + known;
    throw InputError(place, "there is no {" + name + "} in " + derived_.system.file +
                                did_you_mean(name, names) + "; it has " + list);
}

Template SolutionFormulas::filled(const Template& original) {
    Template result = original;
    result.text.clear();
    result.written = original.text;
    const std::string& text = original.text;
    const std::string ending = ".in"; // of a template's name
    const std::string& file = original.place.file;
    const bool is_code =
        original.is_file &&
        is_code_of(language_,
                   file.ends_with(ending) ? file.substr(0, file.size() - ending.size()) : file);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t brace = text.find('{', at);
        result.text.append(text, at, brace - at);
        if (brace == std::string::npos)
            break;
        const std::size_t end = text.find('}', brace);
        const std::string name =
            end == std::string::npos ? "" : text.substr(brace + 1, end - brace - 1);
        const bool doubled = text.compare(brace, 2, "{{") == 0;
        if (doubled || !is_formula(name)) {
            result.text.append(text, brace, doubled ? 2 : 1);
            at = brace + (doubled ? 2 : 1);
            continue;
        }
        result.text += text_of(name, place_in(original, brace), is_code);
        used_ = true;
        at = end + 1;
        result.pieces.push_back({result.text.size(), at});
    }
    return result;
}

} // namespace tvbeam
