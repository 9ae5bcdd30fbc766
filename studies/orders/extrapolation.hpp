/// What a sequence of solutions says of its own limit, where no exact solution is known.
///
/// A computed number f(h) = f_0 + C h^p: Richardson's extrapolation to f_0, and Roache's grid
/// convergence index, the interval about the finest value that is meant to hold f_0:
///
///     f_0 ≈ f_1 + (f_1 − f_2) / (r^p − 1),      GCI = F |f_1 − f_2| / (r^p − 1),      r = h_2 /
///     h_1 > 1,
///
/// with 1 the finest grid, F = 1.25 where p is observed on three grids and F = 3 where it is
/// assumed (Roache 1994, 1997). p keeps its sign. The GCI here is in the unit of f, not relative to
/// it: a limit of zero is a limit.
#pragma once

#include <optional>
#include <span>

namespace tvbeam {

struct GridValue {
    double h = 0;
    double value = 0;
};

struct Extrapolation {
    double order = 0;
    /// f_0; NaN where the order is not positive, for then there is no limit to go to
    double limit = 0;
    /// about the finest value, in the unit of f; infinite where the order is not positive
    double gci = 0;
};

/// The signed order observed on three grids, the solution of
///
///     (f_3 − f_2) / (f_2 − f_1) = r_21^p (r_32^p − 1) / (r_21^p − 1),
///
/// whose right side grows with p throughout. None where the left side is not positive: the values
/// oscillate or stand still, and have no such order.
std::optional<double> observed_order(const GridValue& coarse, const GridValue& medium,
                                     const GridValue& fine);

/// None where there is no observed order. std::invalid_argument unless h falls from grid to grid.
std::optional<Extrapolation> richardson(const GridValue& coarse, const GridValue& medium,
                                        const GridValue& fine);

/// With the order assumed; F = 3. std::invalid_argument unless h falls and the order is positive.
Extrapolation richardson(const GridValue& coarse, const GridValue& fine, double assumed_order);

/// f = f_0 + C h^p fitted to four or more grids, weights 1/h as Eça and Hoekstra (2014) have them.
struct LimitFit {
    double limit = 0;
    double limit_se = 0;
    double order = 0;
    double order_se = 0;
    int dof = 0;
    /// half of the 95 % Student interval of the order
    double order_half_width = 0;
    /// largest distance of the order observed on three neighbouring grids from the fitted one;
    /// infinite where three neighbours have no order
    double order_scatter = 0;
    /// F |f_1 − f_0| + half of the 95 % Student interval of f_0, with F = 1.25: about the finest
    /// value
    double uncertainty = 0;

    /// what to quote behind ±: the greater of half-width and scatter
    double order_uncertainty() const;
};

/// Any sequence of widths. None where fewer than four finite values or three widths are there, or
/// the search does not end at a positive order.
std::optional<LimitFit> fit_limit(std::span<const GridValue> grids);

} // namespace tvbeam
