#pragma once

#include "core/run.hpp"

#include <optional>

namespace tvbeam {

/// Runs in the sine basis: all that the rest of the program sees of this folder. Empty where that
/// does not suit the run (SineForm::suits), where it would lose digits (SineForm::loses_digits), or
/// where something was not finite: the general form can then say where and what.
/// Counters::sine_steps of a result says that it was made here.
std::optional<RunResult> run_in_sines(const RunRequest& request, const ProblemData& data,
                                      const Mesh& mesh, const Needs& needs);

/// The vector unit that such runs are made for here, as compilers call it; the last bits of results
/// depend on it.
const char* sine_unit();

} // namespace tvbeam
