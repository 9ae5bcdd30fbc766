#pragma once

#include "studies/data/record_analysis.hpp"

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// What a run refines. A solver that has no mesh, or no steps, leaves the other out.
struct Widths {
    double h = std::numeric_limits<double>::quiet_NaN();
    double dt = std::numeric_limits<double>::quiet_NaN();
};

/// One run of a solver under study.
struct SolverRun {
    Widths widths;
    std::map<std::string, double> errors; ///< by name; empty when failed
    std::string failure;                  ///< what the solver threw; empty when ok
    double seconds = 0.0;                 ///< wall clock
};

/// The runs of a solver and what each of its errors shows.
struct SolverAnalysis {
    std::vector<SolverRun> runs;
    std::map<std::string, RecordAnalysis> errors; ///< by name
};

/// A solver of any kind: its errors at a mesh width and a time step, by name.
using MeasuredSolver = std::function<std::map<std::string, double>(double h, double dt)>;

/// Runs a solver at every pair of widths, in this order, and analyses each of its errors
/// (record_analysis.hpp): a ladder for orders, verdicts and a power law; a grid of three h and
/// three Δt or more for the two-term model. A run that throws a std::exception is one that failed,
/// and the others go on; an error that a run does not name counts as one of a failed run.
SolverAnalysis analyse(const MeasuredSolver& solver, const std::vector<Widths>& widths);

} // namespace tvbeam
