/// Which points the two-term model holds for: a forward search (two_term_fit.hpp says how and why).
#pragma once

#include "studies/orders/two_term_regression.hpp"

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace tvbeam {

struct FitWindow {
    std::vector<Eigen::Index> members; ///< ascending
    LeastSquares fit;
    /// p and q of a fit that has the next terms too, where the data ask for those
    std::optional<double> p_with_next = std::nullopt;
    std::optional<double> q_with_next = std::nullopt;
};

/// All points, judged by nobody.
std::optional<FitWindow> whole_window(const TwoTermPoints& points);

/// The window that grows from the finest consistent half. None where no half can be fitted.
std::optional<FitWindow> forward_window(const TwoTermPoints& points);

} // namespace tvbeam
