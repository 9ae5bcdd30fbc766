#pragma once

#include "mms/equations/code.hpp"

#include <set>
#include <string>

namespace tvbeam {

/// Names that functions, their arguments and what they share may not have in a language.
const std::set<std::string>& reserved_words(CodeLanguage language);

/// Names that a module of Fortran, or a namespace of C++, may not have: of its intrinsic functions;
/// of what headers declare at global scope. Of no other language.
std::set<std::string> global_names(CodeLanguage language);

} // namespace tvbeam
