#pragma once

namespace tvbeam {

/// The mass matrix of the heat equation: (χ_i, χ_j), or its row sums on the diagonal.
enum class ThermalMass { consistent, lumped };

} // namespace tvbeam
