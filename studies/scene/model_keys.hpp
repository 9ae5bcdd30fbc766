#pragma once

#include "core/problem.hpp"
#include "core/space/mesh.hpp"

namespace tvbeam {

class TableReader;

/// Reads the block [beam]: alpha, zeta, theta_A, stops and contact. Throws InputError where a value
/// is missing or breaks its rule.
Beam read_beam(TableReader table);

/// Reads the block [mesh]: grading, or nodes that every mesh has. Throws InputError as above.
MeshFamily read_mesh(TableReader table);

} // namespace tvbeam
