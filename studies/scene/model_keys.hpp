#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"
#include "mms/given_problem.hpp"

namespace tvbeam {

class TableReader;

/// Reads the block [beam]: alpha, zeta, theta_A, stops and contact. Throws InputError where a value
/// is missing or breaks its rule.
Beam read_beam(TableReader table);

/// Reads the block [mesh]: grading, or nodes that every mesh has. Throws InputError as above.
MeshFamily read_mesh(TableReader table);

/// Reads the block [data]: theta0, u0, heat_source, body_force.
GivenData read_data(TableReader table);

/// Reads a defect: the same and moment_load, one of them at least. Throws InputError as above.
GivenData read_defect(TableReader table);

} // namespace tvbeam
