#pragma once

#include "mms/expression/tape.hpp"

#include <ginac/ginac.h>

#include <vector>

namespace tvbeam {

/// Compiles expressions in x and t of model_symbols(). Integer and half-integer powers become
/// multiplications and square roots; constants are folded; equal subexpressions, of all
/// expressions, are computed once. The order of operations depends on the expressions alone, so
/// that every run gives the same bits. Throws AlgebraError if a constant is not a finite double or
/// a symbol other than x and t is left.
Tape compile_tape(const std::vector<GiNaC::ex>& expressions);

} // namespace tvbeam
