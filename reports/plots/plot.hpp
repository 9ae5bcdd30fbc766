#pragma once

#include "reports/plots/drawing.hpp"
#include "studies/study.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A figure and what is said of it.
struct Plot {
    std::string name;    ///< of its files, without ending
    std::string caption; ///< what it shows, in words
    Drawing drawing;
};

/// The same, each with a name of its own in letters, digits and _, which gnuplot, file systems and
/// the ids of a page take; one whose name is of these already keeps it.
std::vector<Plot> with_file_names(std::vector<Plot> plots);

/// Every figure that a result has; each kind is a function in a file of its own.
std::vector<Plot> plots_of(const StudyResult& result);

/// The ladder's errors against h, or Δt where h stays: measured, fitted with its slope, printed.
std::vector<Plot> convergence_plots(const StudyResult& result);

/// Each norm of [orders] over the plane of h and Δt: the model's lines of equal error, the line
/// along which its two terms are equal, and the runs.
std::vector<Plot> error_surface_plots(const StudyResult& result);

/// Each norm of [work_precision] against run time, a line a scheme.
std::vector<Plot> run_time_plots(const StudyResult& result);

/// Each probe of [evolution] over time.
std::vector<Plot> evolution_plots(const StudyResult& result);

/// The outcomes of [stress] over the two parameters that tell most about them.
std::vector<Plot> stress_plots(const StudyResult& result);

/// The map of [stress.contraction] over α and Δt, and its predicted level lines.
std::vector<Plot> contraction_plots(const StudyResult& result);

/// The floors of [stress.roundoff] against the number of elements.
std::vector<Plot> round_off_plots(const StudyResult& result);

} // namespace tvbeam
