#pragma once

#include "core/certify/solve_record.hpp"

namespace tvbeam {

/// How far the state that a solver starts from is from that of the discretisation: Θ⁰ is
/// θ̃(x,0) − θ_A (1 − x) at the inner nodes and zero at both ends, w⁰ the L² projection of u_xx(x,0)
/// on what is linear on every element. Over the largest sizes of the two; with the options of
/// SolveRecorder.
double initial_defect(const Beam& beam, const ProblemData& data, const Mesh& mesh,
                      const RecordOptions& options, const SolverState& initial);

} // namespace tvbeam
