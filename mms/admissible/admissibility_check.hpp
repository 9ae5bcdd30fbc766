#pragma once

#include "core/problem.hpp"
#include "mms/derivation.hpp"

namespace tvbeam {

/// require_admissible (admissibility.hpp) for a solution that is derived already. `solution` gives
/// the places.
double check_admissible(const Solution& solution, const DerivedSolution& derived, const Beam& beam,
                        double final_time);

/// Throws InputError unless final_time is positive and finite.
void require_final_time(double final_time);

} // namespace tvbeam
