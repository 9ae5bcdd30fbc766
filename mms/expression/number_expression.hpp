#pragma once

#include "mms/text/source_text.hpp"

#include <map>
#include <string>

namespace tvbeam {

/// The value of an expression in the language of the solution files, for given values of the names
/// it may use besides pi; e.g. `0.01/s` with s = 40. Throws InputError where it does not parse or
/// is not a finite number.
double number_from_expression(const SourceText& expression,
                              const std::map<std::string, double>& values = {});

} // namespace tvbeam
