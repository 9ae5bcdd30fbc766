#pragma once

#include "core/problem.hpp"
#include "mms/expression/plain_expression.hpp"
#include "mms/solution.hpp"

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// A phase of a solution as symbolic expressions in model_symbols() and the solution's parameters.
struct PhaseExpressions {
    GiNaC::ex begin;          ///< the time the phase begins at: 0, or the end of the one before
    GiNaC::ex end;            ///< meaningless in the last phase
    double begin_value = 0.0; ///< the same times as numbers
    double end_value = 0.0;   ///< infinite in the last phase
    GiNaC::ex theta;
    GiNaC::ex u;
    GiNaC::ex sigma;
    PlainExpression plain_theta, plain_u; ///< the same as they are written
    PlainExpression plain_sigma;          ///< empty: zero
};

/// A solution as symbolic expressions.
struct SolutionExpressions {
    GiNaC::exmap parameters; ///< symbol → value
    std::map<std::string, PlainExpression> plain_parameters;
    std::vector<PhaseExpressions> phases;
};

/// Throws InputError at the character at fault: whatever the parser refuses, a parameter or an
/// `until` that is no finite number, times that do not increase.
SolutionExpressions expressions_of(const Solution& solution);

/// The same with the parameters' and the beam's values in the place of their symbols; only x and t
/// are left. Where stops are penalised, a σ̃ that is not given is the law's: −((u(1,t) − g2)⁺ −
/// (g1 − u(1,t))⁺)/ε. Throws InputError further where a stop is named that the beam does not have,
/// and where an expression has no value.
SolutionExpressions expressions_on(const Solution& solution, const Beam& beam);

} // namespace tvbeam
