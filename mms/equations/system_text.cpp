#include "mms/equations/system_text.hpp"

#include "mms/equations/infix.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/printing.hpp"
#include "mms/expression/shortened.hpp"
#include "mms/text/number_text.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

namespace tvbeam {

using GiNaC::ex;
using Role = DerivedFunction::Role;

namespace {

constexpr std::size_t longest_written = 400;

/// With the exact solution put in, where that is short.
std::optional<std::string> with_solution(const DerivedSystem& derived,
                                         const DerivedFunction& function, auto written) {
    try {
        std::string text = written(shortened(derived.fields.exact(function.formula)));
        if (text.size() <= longest_written)
            return text;
    } catch (const AlgebraError&) { // too large: it is left in its derivatives
    }
    return std::nullopt;
}

std::string parameters_text(const DerivedSystem& derived) {
    std::string text;
    for (const auto& parameter : derived.parameters)
        text += (text.empty() ? "" : ", ") + parameter.name + " = " + exact_text(parameter.value);
    return text;
}

/// The derivatives that occur in what is not written out.
using Needed = std::map<std::string, ex>;

void need(Needed& needed, const DerivedSystem& derived, const ex& formula) {
    for (const EquationField* field : derived.fields.occurring_in(formula))
        if (field->symbol.get_name() != field->unknown)
            needed[field->symbol.get_name()] = field->exact;
}

void add_formula(std::string& text, const DerivedSystem& derived, const DerivedFunction& function,
                 Needed& needed) {
    const std::string in_fields = formula_text(function.formula);
    text += "  " + function.of + " = " + function.origin + "\n";
    if (in_fields != function.origin)
        text += "    = " + in_fields + "\n";
    const auto solved = with_solution(derived, function, formula_text);
    if (!solved)
        need(needed, derived, function.formula);
    else if (*solved != in_fields)
        text += "    = " + *solved + "\n";
}

/// u_xx as u_{xx}; v1_x as v_{1,x}.
std::map<std::string, std::string> latex_names(const DerivedSystem& derived) {
    std::map<std::string, std::string> names;
    for (const auto& function : derived.functions)
        for (const EquationField* field : derived.fields.occurring_in(function.formula)) {
            const std::string name = field->symbol.get_name();
            if (name == field->unknown)
                continue;
            const std::string by = name.substr(field->unknown.size() + 1);
            const std::string unknown = formula_latex(GiNaC::realsymbol(field->unknown));
            const bool has_subscript = unknown.ends_with('}') && unknown.find("_{") != unknown.npos;
            if (has_subscript)
                names[name] = fmt::format("{},{}}}", unknown.substr(0, unknown.size() - 1), by);
            else if (unknown.find('_') == unknown.npos)
                names[name] = fmt::format("{}_{{{}}}", unknown, by);
            else // a name may have no two subscripts
                names[name] = fmt::format("{{{}}}_{{{}}}", unknown, by);
        }
    return names;
}

std::string role_title(Role role) {
    switch (role) {
    case Role::source:
        return "Sources";
    case Role::boundary:
        return "Boundary values";
    case Role::initial:
        return "Initial values";
    default:
        return "Exact solution";
    }
}

} // namespace

std::string system_text(const DerivedSystem& derived) {
    std::string text = derived.system.name;
    if (!derived.system.source.empty())
        text += " (" + derived.system.source + ")";
    text += "\n";
    if (const std::string parameters = parameters_text(derived); !parameters.empty())
        text += "with " + parameters + "\n";
    Needed needed;
    for (const Role role : {Role::source, Role::exact, Role::boundary, Role::initial}) {
        const auto functions = derived.of_role(role);
        if (functions.empty())
            continue;
        text += "\n" + role_title(role) + "\n";
        for (const DerivedFunction* function : functions) {
            if (role == Role::exact) {
                const auto value = with_solution(derived, *function, formula_text);
                text += "  " + function->of + " = " + value.value_or(function->origin) + "\n";
                continue;
            }
            if (!function->place.empty())
                text += "  at " + function->place + "\n";
            add_formula(text, derived, *function, needed);
        }
    }
    if (!needed.empty())
        text += "\nwith the derivatives\n";
    for (const auto& [name, exact] : needed) {
        const std::string formula = formula_text(exact);
        text += "  " + name + " = " +
                (formula.size() > longest_written ? formula.substr(0, longest_written) + "…"
                                                  : formula) +
                "\n";
    }
    return text;
}

std::string system_latex(const DerivedSystem& derived) {
    const auto names = latex_names(derived);
    const auto latex = [&](const ex& expression) { return formula_latex_named(expression, names); };
    std::string text = "\\begin{align*}\n";
    Needed needed;
    std::set<Role> shown = {Role::source, Role::exact, Role::boundary, Role::initial};
    for (const auto& function : derived.functions) {
        if (!shown.contains(function.role))
            continue;
        const std::string in_fields = latex(function.formula);
        const std::string place = function.place.empty() ? "" : " && (" + function.place + ")";
        const std::string left = formula_latex(GiNaC::realsymbol(function.of));
        if (function.role == Role::exact) {
            text += left + " &= " + with_solution(derived, function, latex).value_or("\\dots") +
                    " \\\\\n";
            continue;
        }
        text.append(left).append(" &= ").append(in_fields).append(place).append(" \\\\\n");
        const auto solved = with_solution(derived, function, latex);
        if (!solved)
            need(needed, derived, function.formula);
        else if (*solved != in_fields)
            text += "  &= " + *solved + " \\\\\n";
    }
    for (const auto& [name, exact] : needed)
        text += names.at(name) + " &= " + latex(exact) + " \\\\\n";
    text.resize(text.size() - 4); // the last line ends nothing
    return text + "\n\\end{align*}\n";
}

} // namespace tvbeam
