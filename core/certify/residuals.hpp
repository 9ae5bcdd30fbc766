#pragma once

#include "core/certify/solve_record.hpp"

namespace tvbeam {

/// The largest residuals of the two discrete equations of a solve (SolveRecord), in units of
/// round-off: of ε times the sum of the largest sizes of the terms; infinite where Θ is not zero at
/// both ends. w counts with the terms that it
/// is the sum of (RecordedState::curvature_size). Throws std::domain_error where these sizes are
/// beyond the range of doubles.
struct Residuals {
    double heat = 0.0; ///< over the inner nodes
    double beam = 0.0; ///< over both ends of every element
};

/// underflow: in the units of the record, below which floating point is absolute; 0: never.
Residuals residuals(const Beam& beam, const Mesh& mesh, ThermalMass mass, const SolveRecord& record,
                    double underflow);

} // namespace tvbeam
