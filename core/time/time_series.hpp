#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// Functions of time at the solves or steps of a block: a column each, a row a time. Only the first
/// rows are in use where a block is short.
using TimeSeries = Eigen::MatrixXd;

} // namespace tvbeam
