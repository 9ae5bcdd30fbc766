#pragma once

#include "core/scheme.hpp"

namespace tvbeam {

class TableReader;

/// Reads the keys of a scheme from a table that may hold others: algorithm, time, thermal_mass,
/// tolerance, basis. What is absent stays as in `scheme`. Throws InputError at a value that is not
/// one of the choices, or at a key that does not belong to the algorithm.
Scheme read_scheme_keys(TableReader& table, Scheme scheme);

} // namespace tvbeam
