/// What a sequence of computed numbers says of its limit, where no exact solution is known: one
/// answer with an interval, and what the methods that have names say, beside it.
///
/// Models f(h) = f_0 + C h^p (p free, 1 or 2; where the steps go to and fro also with a C that
/// does), f_0 + C h + D h², f_0 + C h^p (1 + D h) and f_0 + C h^p (1 + D h^p) are fitted to windows
/// of consecutive levels. A fit is believed as far as its limit stays where it is when the window
/// moves by one level, as its standard error allows, and as far as the change would still grow if
/// the sequence went on (with δ from one window to the next, r their ratio of widths):
///
///     u_m² = max(t_{dof} s_m / 1.96, σ_m)² + (δ_m / (r' − 1))² + b_m²,
///
/// r' = √r for models with a given p and r^min(p, 1) for others, b_m how far the model goes back
/// where it turns behind the finest of no more than four levels: f_0 + C h + D h² may follow those
/// of h³ + c h⁴ so,
///
/// with s_m from the residuals and σ_m from a stated deviation, that of replicates or that of
/// rounding to the digits printed, where the finest step is so few of their units that it counts.
///
/// Where the finest step is no more than so many deviations from the best model, the values
/// scatter: an order is determined where it is with that scatter, too, and the interval is wider
/// where their steps are erratic.
///
/// The limit is the mean with weights 1 / u_m², its interval their spread, as in order_engine.hpp.
#pragma once

#include "studies/orders/named_limits.hpp"
#include "studies/orders/order_engine.hpp"

#include <limits>
#include <optional>
#include <span>
#include <string>

namespace tvbeam {

struct LimitTuning {
    double factor = 1.1;     ///< half of the interval over the spread
    double scattered = 1.7;  ///< the same where the values scatter
    double exact_steps = 30; ///< a finest step of fewer deviations is one of values that scatter
    double few_levels = 3.0; ///< … and this much more over the square of the levels less two
    double narrowest = 0.01; ///< of the distance from the finest value to the limit
    double agreement = 0.01; ///< added to u_m in the weights, of the last step between levels
    /// Of so many units of the last digit printed, rounding makes 0.2 % of the finest step: less
    /// than no change of windows shows.
    double units_of_exact_steps = 200;
    /// An order of powers below which the interval holds what models in ln h say, too. Of a seed
    /// that this was not chosen by it holds the limits of all 94 values whose error is c/ln h and
    /// of 147 of 157 of its square, of which it held 0 and 8 without them; those of order 1 and
    /// more, which it held, are as wide as before.
    double logarithmic_below = 0.9;
    /// Below it, where the order of the steps falls over all windows, the intervals of 423 limits
    /// of 433 missed whose error is 1/ln h, its square, h^¼, h + c h^¼ or h + c √h, of a seed that
    /// this was not chosen by; with 3 more, of powers of 1 and more, none was.
    double slow_order = 0.5;
    /// Or below the first, where it falls by more than this: of h² + c √h 19 more are left out, of
    /// which 15 missed. 37 of the 272 that stay miss.
    double first_order = 1.0;
    double far_fall = 0.5;
};

struct LimitEstimate {
    OrderInterval limit;
    OrderInterval order;
    double uncertainty =
        std::numeric_limits<double>::infinity(); ///< of the finest value, 95 %, half width
    std::string basis;                           ///< what it rests on: "5 levels, 21 fits"
    MethodAnswer gci;                            ///< Roache 1994, 1997; above order 4 with factor 3
    MethodAnswer celik;                          ///< Celik et al. 2008
    MethodAnswer eca_hoekstra;                   ///< Eça and Hoekstra 2014
    /// In units of the last digit printed, where these are coarse enough to widen the intervals.
    std::optional<double> finest_step;
};

/// Rows that are not finite are passed over; rows of one width are averaged. Values whose steps
/// grow up to the finest have no limit, nor have those the order of whose steps falls over finer
/// windows below slow_order; the status says so. The limit is that of models in powers of h; where
/// the order is below logarithmic_below, its interval reaches that of those in ln h with them.
LimitEstimate estimate_limit(std::span<const ValueRow> rows, const LimitTuning& tuning = {});

} // namespace tvbeam
