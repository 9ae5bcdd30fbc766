#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"
#include "mms/plain_solution.hpp"

namespace tvbeam {

/// require_admissible (admissibility.hpp) for a solution that is derived already. `solution` gives
/// the places. Throws InputError too where a derived formula is not what `plain`, the same
/// solution's, says.
double check_admissible(const Solution& solution, const DerivedSolution& derived,
                        const PlainSolution& plain, const Beam& beam, double final_time);

/// Throws InputError unless final_time is positive and finite.
void require_final_time(double final_time);

} // namespace tvbeam
