/// Which line a grid is best refined by: one mesh more, run with every step, or one step more, run
/// with every mesh.
///
/// Of e² = T² + 2ρTS + S² with T = a h^p exp(β_i) and S = b Δt^q exp(γ_j), fitted to the present
/// grid with β = γ = 0, the standard errors that another grid would give follow from the Jacobian J
/// of ln e by (ln a, p, ln b, q, ρ, β_1 …, γ_1 …):
///
///     cov = s² (JᵀJ + D)⁻¹,     D = diag(s², …, s², 1, …, 1).
///
/// s² is that of the present residuals: of the scatter of a row, and of β_i and γ_j, what a mesh
/// and a step have too much by next terms, which is the same in all of their runs, so that these
/// say it once. An order that no row shows is uncertain by about one. An interval then narrows as
/// its standard error does; the limit of a value as h^p or Δt^q do.
#pragma once

#include "studies/grid/grid.hpp"
#include "studies/grid/grid_lines.hpp"

#include <vector>

namespace tvbeam {

/// An interval that is not yet known, in parts of what it is to be: at present, and as it is
/// expected to be with another line.
struct OpenInterval {
    double now = 0.0;
    double with_mesh = 0.0;
    double with_step = 0.0;
};

/// What is expected of an interval of the fit: of p, or of q. wanted: half of it.
OpenInterval open_order(const TwoTermFit& fit, bool in_h, double wanted, const GridLines& lines,
                        const GridLines& finer_mesh, const GridLines& finer_step);

/// The same of a value's limit.
OpenInterval open_limit(const GridLimit& limit, double wanted, const GridLines& lines,
                        const GridLines& finer_mesh, const GridLines& finer_step);

/// By how much a line of so much cost narrows the widest of the intervals: a part, over the cost.
double gain_of_mesh(const std::vector<OpenInterval>& open, double cost);
double gain_of_step(const std::vector<OpenInterval>& open, double cost);

/// Seconds of a run that was not made, by the power law sec = c s^α n^β, n = 1/Δt, of those on the
/// finest three meshes and steps; α, β ≥ 0. Zero where
/// their clock shows none.
class ForecastSeconds {
public:
    ForecastSeconds(const GridLines& lines, const std::vector<RungResult>& runs);
    double operator()(const Rung& run) const;

private:
    double log_factor_ = 0.0;
    double in_elements_ = 1.0;
    double in_steps_ = 1.0;
};

} // namespace tvbeam
