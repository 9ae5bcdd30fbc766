#pragma once

#include "reports/plots/plot.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What gnuplot made of a figure.
struct DrawnPlot {
    std::string svg; ///< empty where it could not be drawn
    std::string png; ///< the same
    std::string pdf; ///< the same
};

/// The figures that gnuplot drew, as many as there are plots, and why some could not be drawn.
struct DrawnPlots {
    std::vector<DrawnPlot> plots;
    std::string failure; ///< a sentence; empty where all were drawn
};

/// Runs gnuplot on each script, in a directory of its own that goes again. Where gnuplot is not
/// installed, fails, or writes half a picture, where there is no room for the scripts, and where
/// the end is asked for (EndRequests), `failure` says so.
DrawnPlots draw(const std::vector<Plot>& plots);

} // namespace tvbeam
