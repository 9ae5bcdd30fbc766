#pragma once

#include "studies/orders/order_engine.hpp"

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <span>

namespace tvbeam {

struct ValueRow {
    double h = 0;
    double value = 0;
    /// Standard deviation; NaN: unknown. Counts where all rows have one.
    double sigma = std::numeric_limits<double>::quiet_NaN();
    /// Of the last digit printed; 0: the value is exact, or σ knows of rounding.
    double unit = 0;
};

/// The orders that are searched for one that is free.
inline constexpr double least_order = 0.2;
inline constexpr double greatest_order = 8;

/// A model of f: powers of h beside the constant. One that is free is searched for.
struct LimitModel {
    std::optional<double> order; ///< none: free
    /// A further term: of one power more, or of the double power, as of a series in h^p.
    enum class Next { none, one_more, doubled };
    Next next = Next::none;
    bool alternating = false; ///< C changes its sign from level to level
    /// k > 0: in place of h^p (1 + p ln(h_0/h)/k)^-k, with the coarsest h_0, at which p is its
    /// order: the longer h falls, the more like 1/ln^k.
    int logarithmic = 0;
    int parameters() const { return 2 + (order ? 0 : 1) + (next == Next::none ? 0 : 1); }
};

struct LinearFit {
    double limit = 0;
    double limit_error = 0; ///< over 1.96 it is an interval's half; 0 without residuals and σ
    double order = 0;
    double square = infinity; ///< sum of weighted squares
    double finest = 0;        ///< the model's value at the finest level
    int dof = 0;
    /// How far the model goes back behind the finest level, where it turns there.
    double goes_back = 0;
};

/// 1/σ² over its mean, and the standard deviation at weight one, 0 where it is not known.
struct Weights {
    Eigen::VectorXd relative;
    double scatter = 0;
};

/// The weighted least-squares fit of a model to rows from coarse to fine; a free order is the best
/// within the bounds, none at a bound. None where there are fewer rows than parameters.
std::optional<LinearFit> fit_limit_model(std::span<const ValueRow> rows, const Weights& weights,
                                         const LimitModel& model);

} // namespace tvbeam
