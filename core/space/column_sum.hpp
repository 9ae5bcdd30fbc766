#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// y += Σ_r factors_r columns_r, which reads and writes y once. Shapes: n, n × R, R. Where the
/// processor fuses a product and a sum, the last bits differ.
void add_columns(Eigen::Ref<Eigen::VectorXd> y, const Eigen::MatrixXd& columns,
                 const Eigen::VectorXd& factors);

} // namespace tvbeam
