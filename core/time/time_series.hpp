#pragma once

#include <Eigen/Core>

namespace tvbeam {

/// Functions of time at the solves or steps of a block: a column each, a row a time. Only the first
/// rows are in use where a block is short.
using TimeSeries = Eigen::MatrixXd;

/// out += in · matrix in the first `rows` rows. Zeros of the matrix, which are most, cost nothing.
inline void add_product(TimeSeries& out, const TimeSeries& in, const Eigen::MatrixXd& matrix,
                        Eigen::Index rows) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::Index i = 0; i < matrix.rows(); ++i)
            if (const double factor = matrix(i, j); factor != 0.0)
                out.col(j).head(rows) += factor * in.col(i).head(rows);
}

/// out += vᵀ G v for every row v of the series; G symmetric.
inline void add_forms(Eigen::VectorXd& out, const TimeSeries& series, const Eigen::MatrixXd& gram,
                      Eigen::Index rows) {
    for (Eigen::Index j = 0; j < gram.cols(); ++j)
        for (Eigen::Index i = 0; i <= j; ++i)
            if (const double factor = (i == j ? 1.0 : 2.0) * gram(i, j); factor != 0.0)
                out.head(rows) +=
                    factor * series.col(i).head(rows).cwiseProduct(series.col(j).head(rows));
}

} // namespace tvbeam
