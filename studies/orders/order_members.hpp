/// Fits of many models to many windows of rows.
#pragma once

#include "studies/orders/error_rows.hpp"
#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace tvbeam {

/// One fit of one model to one window.
struct EnsembleMember {
    TermFit fit;
    int family = 0;          ///< members of one family have one model
    std::vector<int> place;  ///< the window; neighbours differ by one in one number
    Eigen::Index along = -1; ///< the one width that it knows; -1: all

    bool is_of_all_rows() const {
        return along < 0 && std::ranges::all_of(place, [](int dropped) { return dropped == 0; });
    }
};

/// Families of members are the models of all widths, and, from this on for each width in turn,
/// those of it alone; the first of each is that of the leading terms.
constexpr int families_of_a_width = 100;
/// Among the models of a sequence.
constexpr int logarithmic_family = 3;

/// What rounding leaves of ln e where a model is exact, and the search for it.
constexpr double scale_of_rounding = 1e-7;

/// Of two fits of the same rows: whether the scatter that is left by the first is ten times as much
/// and more, and not rounding.
bool is_far_worse(const TermFit& fit, const TermFit& other);

/// The greatest part of an error that the term of one width is, of all rows.
double share_of_errors(const TermFit& fit, Eigen::Index width, const TermRows& rows);
/// The root of the mean square of that part, over all rows.
double mean_share_of_errors(const TermFit& fit, Eigen::Index width, const TermRows& rows);

/// All fits that are believed. A sequence has windows down to the two finest levels; other rows
/// such of at least three levels and half of them, in each width, and each width alone on the rows
/// where the others are finest.
/// levels: of each width, coarse to fine.
std::vector<EnsembleMember> fit_members(const TermRows& rows,
                                        const std::vector<std::vector<double>>& levels);

} // namespace tvbeam
