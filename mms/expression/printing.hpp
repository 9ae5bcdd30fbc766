#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>

namespace tvbeam {

/// The expression as text that the parser reads back as the same function; the same text in every
/// run.
std::string formula_text(const GiNaC::ex& expression);

/// The expression in LaTeX's mathematical mode.
std::string formula_latex(const GiNaC::ex& expression);

/// The same, with symbols written as `names` says, where it does.
std::string formula_latex_named(const GiNaC::ex& expression,
                                const std::map<std::string, std::string>& names);

} // namespace tvbeam
