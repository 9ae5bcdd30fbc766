/// Where the searches for the parameters of term_model.hpp begin.
#pragma once

#include "studies/orders/term_layout.hpp"
#include "studies/orders/term_model.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// Of the leading terms, or of these with one next term x^k: the best few of a net of orders, moved
/// to the best order of the width that has the next term; and of the leading terms alone the best
/// with one that stands still, where that is better than all of those.
std::vector<Eigen::VectorXd> starts_of(const Layout& layout, const TermRows& rows);

/// θ of the leading terms with next terms of size zero, and a floor far below.
Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows,
                           const Eigen::VectorXd& leading);

/// The same from a shorter model.
Eigen::VectorXd lengthened(const Layout& layout, const TermRows& rows, const TermFit& simpler);

/// Where a term has a logarithm, each start with one of size zero, for errors that have none, and
/// of either sign with the same slope in the middle: at zero its derivative and that by the order
/// are one.
std::vector<Eigen::VectorXd> with_logarithms(const Layout& layout,
                                             std::vector<Eigen::VectorXd> starts);

/// θ of a fit to other rows, in the units of these: the same curve.
Eigen::VectorXd in_units(const Layout& layout, const TermFit& fit, const Eigen::VectorXd& centre,
                         double log_unit);

} // namespace tvbeam
