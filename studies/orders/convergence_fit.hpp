/// One error term along a ladder: e = C (h^p − h_ref^p) + floor, fitted on ln e by weighted least
/// squares.
///
/// h is the width that is refined: the mesh width where it changes over the records, else the time
/// step. h_ref is the width of a reference run that stands in for the exact solution: what is
/// measured is then the distance to the reference, whose own error C h_ref^p is of the same form.
/// Without a reference the term is C h^p. The floor is what refinement does not remove: rounding,
/// or a term of the other width.
///
/// The noise of an error is taken as multiplicative, so that of ln e has one variance, estimated
/// from the residuals. Intervals are Student's. Squares may be fitted here, with twice the order.
#pragma once

#include "studies/orders/observed_order.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace tvbeam {

struct PowerLawOptions {
    /// Look for a floor. It is kept where an F test at 1 % prefers it; else the fit is that of C
    /// h^p.
    bool with_floor = false;
    /// Width of the reference run, finer than every record.
    std::optional<double> reference_width = std::nullopt;
    /// Relative weight of each record: 1 / variance of ln e, up to a factor. Empty: all one.
    std::span<const double> weights = {};
};

struct PowerLawFit {
    double c = 0;
    double p = 0;
    double floor = 0;
    double reference_width = 0;

    /// of (ln C, p), or (ln C, p, ln floor) where there is a floor
    Eigen::MatrixXd covariance;
    double log_c_se = 0;
    double p_se = 0; ///< infinite for two points
    double floor_se = 0;
    int dof = 0;
    double rms = 0; ///< sqrt(χ² / dof): the relative scatter of the errors about the fit

    double p_half_width = 0; ///< of the 95 % Student interval of p
    /// The largest distance of a pairwise order of neighbours from p. Where a floor or a reference
    /// bends the ladder, it is the pairwise orders of e − (fit's floor and reference part) that are
    /// meant.
    double p_scatter = 0;
    std::vector<std::size_t> used; ///< the records with a finite, positive error and width

    /// What to quote behind ±: it covers both the sampling error and the scatter that is seen.
    double p_uncertainty() const;
    double error(double width) const;
};

/// None where fewer than two records (with a floor: four) or fewer than two (three) widths are
/// usable. std::invalid_argument where the weights are not one positive number a record, or the
/// reference is not finer than every usable record.
std::optional<PowerLawFit> fit_power_law(std::span<const Refinement> records,
                                         const PowerLawOptions& options = {});

} // namespace tvbeam
