#pragma once

#include "mms/expression/plain_expression.hpp"
#include "mms/text/source_text.hpp"

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <string>

namespace tvbeam {

/// The names an expression may use, besides pi and the functions.
using SymbolTable = std::map<std::string, GiNaC::ex>;

/// Reads an expression.
///
///     sum     = product { ("+" | "-") product }
///     product = signed { ("*" | "/") signed }
///     signed  = { "+" | "-" } power
///     power   = primary [ "^" signed ]            so that 2^3^2 = 2^9 and -x^2 = -(x^2)
///     primary = number | name | function "(" sum ")" | "(" sum ")"
///     number  = digits [ "." digits ] [ "e" [sign] digits ], read as an exact rational
///
/// Bounds: 4096 characters; 100 brackets, signs and powers within each other; 100 digits a number;
/// 400 for the size of a decimal exponent; and those of algebra.hpp for constants. Throws
/// InputError at the character at fault, and nothing else. `plain`: where to put the expression as
/// it is written, besides.
GiNaC::ex parse_expression(const SourceText& source, const SymbolTable& symbols,
                           PlainExpression* plain = nullptr);

/// Where a name is first used in an expression.
std::optional<Place> first_use(const SourceText& source, const std::string& name);

} // namespace tvbeam
