/// Fits of the model of term_model.hpp.
#pragma once

#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tvbeam {

/// Fits to the same rows.
class TermSearch {
public:
    explicit TermSearch(TermRows rows);

    /// The robust fit: least squares, reweighted by Cauchy's function of residual over scatter, so
    /// that a row far out of line counts for nothing. None where there are fewer rows than
    /// parameters, or no start comes to an end. With `simpler`, a fit of these rows without some of
    /// the next terms, the search starts there; with `beside`, a fit of this shape to other rows,
    /// there, too.
    std::optional<TermFit> fit(const TermShape& shape, const TermFit* simpler = nullptr,
                               const TermFit* beside = nullptr);

private:
    const std::vector<Eigen::VectorXd>& starts();

    TermRows rows_; ///< in units of their means
    Eigen::VectorXd log_reference_;
    Eigen::VectorXd log_centre_;
    double log_unit_;
    std::vector<Eigen::VectorXd> starts_; ///< of the leading terms; found when they are asked for
};

} // namespace tvbeam
