#pragma once

#include "reports/plots/plot.hpp"

#include <string>

namespace tvbeam {

/// A figure as pgfplots draws it: a tikzpicture to \input into a paper, as wide as the line that it
/// stands in, with its data in it. What the paper's preamble needs stands in its first lines.
std::string pgfplots_text(const Plot& plot);

} // namespace tvbeam
