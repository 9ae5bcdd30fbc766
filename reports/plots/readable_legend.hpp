#pragma once

#include "reports/plots/drawing.hpp"

namespace tvbeam {

/// A figure of more than twelve series, which no legend tells apart, with its series in shades from
/// the first to the last, and a legend of some of them; any other as it is.
Drawing with_readable_legend(const Drawing& drawing);

} // namespace tvbeam
