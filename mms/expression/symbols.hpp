#pragma once

#include "core/problem.hpp"
#include "mms/expression/expression_parser.hpp"

#include <ginac/ginac.h>

namespace tvbeam {

/// The symbols of the model (1)–(10), the same objects in every expression of the program.
struct ModelSymbols {
    GiNaC::realsymbol x{"x"};
    GiNaC::realsymbol t{"t"};
    GiNaC::realsymbol alpha{"alpha"};
    GiNaC::realsymbol zeta{"zeta"};
    GiNaC::realsymbol g1{"g1"};
    GiNaC::realsymbol g2{"g2"};
    GiNaC::realsymbol theta_A{"theta_A"};
};

const ModelSymbols& model_symbols();

/// All of them by name.
const SymbolTable& model_symbol_table();

/// The beam's values for alpha, zeta, theta_A and those of g1, g2 that are finite, as exact
/// rationals. Throws InputError if alpha, zeta or theta_A is not finite.
GiNaC::exmap beam_values(const Beam& beam);

/// Throws InputError where the expression names a stop that the beam does not have.
void require_stops_in_use(const SourceText& source, const Beam& beam);

} // namespace tvbeam
