/// Which points the two-term model holds for: a forward search (two_term_fit.hpp says how and why).
#pragma once

#include "studies/orders/two_term_regression.hpp"

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace tvbeam {

/// Distinct widths that an order is fitted to, and no fewer.
inline constexpr std::size_t fewest_levels = 3;

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
