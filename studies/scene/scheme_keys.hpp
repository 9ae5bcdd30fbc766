#pragma once

#include "core/scheme.hpp"
#include "studies/scene/study_keys.hpp"

namespace tvbeam {

class TableReader;

/// Reads the keys of a scheme from a table that may hold others: algorithm, time, thermal_mass,
/// tolerance, basis. What is absent stays as in `scheme`. Throws InputError at a value that is not
/// one of the choices, or at a key that does not belong to the algorithm.
Scheme read_scheme_keys(TableReader& table, Scheme scheme);

/// What the blocks of studies may name where the beam is studied: its norms, and schemes that are
/// as `own` where they do not say otherwise.
SolverKeys beam_keys(const Scheme& own);

} // namespace tvbeam
