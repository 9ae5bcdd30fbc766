#pragma once

#include "core/problem.hpp"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace tvbeam {

/// F and H of one problem after the other at points of the beam at one time; shape: 2 problems ×
/// points.
using DrivingSources = std::function<Eigen::ArrayXXd(const Eigen::ArrayXd& x, double t)>;

/// What a driven beam does: coefficients of the Legendre polynomials of [0, 1], one column a step
/// from 0 to the final time.
struct DrivenBeam {
    Eigen::MatrixXd theta;
    Eigen::MatrixXd w;
};

/// Some linear problems of the model, each driven from rest:
///
///     y_t − y_xx − α w_t = F,     w + ζ w_t + α y − l (1 − x) = H,     y = 0 at both ends
///
/// with l = 0, or with l such that ∫ (1 − x) w dx = 0 where the tip is held. In space by Galerkin's
/// method with Legendre polynomials up to the degree `modes`, in time by the Radau IIA method of
/// three stages (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.5): nothing of
/// it is shared with the schemes whose errors it forecasts.
std::vector<DrivenBeam> driven_beams(const Beam& beam, bool held, double final_time,
                                     Eigen::Index modes, Eigen::Index steps, Eigen::Index problems,
                                     const DrivingSources& sources);

/// P_0 … P_{count−1} of [0, 1] at points; shape: count × points.
Eigen::MatrixXd legendre(Eigen::Index count, const Eigen::ArrayXd& x);

/// Coefficients of ∫_0^x; shape: (n + 1) × n.
Eigen::MatrixXd legendre_integral(Eigen::Index count);

} // namespace tvbeam
