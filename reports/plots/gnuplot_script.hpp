#pragma once

#include "reports/plots/drawing.hpp"

#include <string>

namespace tvbeam {

/// The script by which gnuplot draws a figure, to NAME.svg, NAME.png and NAME.pdf. The legend
/// stands below the axes, where it covers nothing, and the picture is made higher by as much.
std::string gnuplot_script(const Drawing& drawing, const std::string& name);

/// The data that the script reads, NAME.dat.
std::string gnuplot_data(const Drawing& drawing);

} // namespace tvbeam
