#include "core/contraction.hpp"

#include "core/space/linear_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tvbeam {

double contraction(const Beam& beam, const Mesh& mesh, ThermalMass mass, double c, Tip tip) {
    const Eigen::Index inner = mesh.elements() - 1;
    if (inner == 0 || beam.alpha == 0.0)
        return 0.0;
    const Tridiagonal consistent = thermal_mass_matrix(mesh, ThermalMass::consistent);
    const TridiagonalFactor solve(thermal_mass_matrix(mesh, mass) +
                                  stiffness_matrix(mesh) * (1.0 / c));
    Eigen::VectorXd arms = Eigen::VectorXd::Zero(inner);
    if (tip == Tip::held)
        arms = hat_loads(mesh, [](const Eigen::ArrayXd& x) -> Eigen::ArrayXd {
                   return 1.0 - x;
               }).segment(1, inner);
    const auto coupled = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        return consistent * v - arms * (3.0 * arms.dot(v));
    };
    // The power method from the mode of λ₁, which on a uniform mesh is an eigenvector already where
    // the tip is free.
    Eigen::VectorXd mode = (std::numbers::pi * mesh.nodes.segment(1, inner)).sin().matrix();
    double eigenvalue = 0.0;
    constexpr int iterations = 8;
    for (int i = 0; i < iterations; ++i) {
        Eigen::VectorXd next = coupled(mode);
        const double norm = mode.dot(next);
        solve.solve_in_place(next);
        eigenvalue = next.dot(coupled(mode)) / norm;
        mode = next / next.cwiseAbs().maxCoeff();
    }
    return beam.alpha * beam.alpha / (1.0 + beam.zeta * c) * eigenvalue;
}

double greatest_contraction(const Beam& beam, const Mesh& mesh, const Scheme& scheme, double dt,
                            Tip tip) {
    double greatest = 0.0;
    for (const TimeScheme* time : {&scheme.time, &scheme.time.at_step(1)})
        for (const Stage& stage : time->stages)
            greatest = std::max(
                greatest, contraction(beam, mesh, scheme.thermal_mass, stage.leading / dt, tip));
    return greatest;
}

} // namespace tvbeam
