#pragma once

#include "mms/equations/derived_system.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

enum class CodeLanguage { c, cpp, fortran, python, julia, freefem, ufl, moose };

/// As they are called: c, c++, fortran, python, julia, freefem, ufl, moose.
const std::vector<std::string>& code_language_names();
std::optional<CodeLanguage> code_language(const std::string& name);

/// All that was derived, as functions in a language: the coordinates that the file names are the
/// arguments, in the order x, y, z, t; parameters are constants before them. Above each function
/// stands what it is and where it comes from; parts that it needs more than once are computed once.
/// Where there are several sources, a function `sources` gives them all at once, in most languages
/// several times faster than one after the other.
///
/// C, C++ (in a namespace), Fortran (in a module), Python (numpy's functions where it is installed,
/// so that arrays do as well) and Julia are files of their own. FreeFEM's is for include, UFL's for
/// import (coordinates are UFL's or numbers), MOOSE's is a block [Functions] of ParsedFunction.
///
/// Names that mean something else in a language get a _ at their end. FreeFEM knows no _ in names:
/// u_exact_x is uexactx there, and what is reserved gets a 0. Throws InputError where two names
/// become one.
std::string system_code(const DerivedSystem& derived, CodeLanguage language);

/// One of the functions as an expression of that language, in brackets, without names but the
/// coordinates and pi: for a template. Throws InputError where it has more than 20 000 characters.
std::string inline_code(const DerivedSystem& derived, const DerivedFunction& function,
                        CodeLanguage language);

/// Whether a file is code of that language, by the ending of its name, as .f90.
bool is_code_of(CodeLanguage language, const std::string& file);

/// A number as an operand in code of that language: 2.0, (-2.0), in Fortran 2.0_dp, in Python 2.
std::string inline_number(double value, CodeLanguage language);

/// What a function is: "f = diff(u, t) - k*laplace(u) (heat.toml:9)".
std::string description_of(const DerivedFunction& function);

} // namespace tvbeam
