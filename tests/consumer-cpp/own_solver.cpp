// A solver that has nothing to do with beams: its orders in the mesh width and in the time step.

#include "studies/data/solver_analysis.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

namespace {

/// u_t = u_xx on (0, 1) with u0 = sin πx and zero ends, by central differences and implicit Euler,
/// up to t = 0.1; each step is one elimination (Thomas). The errors at that time.
std::map<std::string, double> heat_errors(double h, double dt) {
    const auto nodes = static_cast<std::size_t>(std::lround(1.0 / h)) - 1;
    const long steps = std::lround(0.1 / dt);
    const double r = dt / (h * h);
    std::vector<double> u(nodes);
    for (std::size_t i = 0; i < nodes; ++i)
        u[i] = std::sin(std::numbers::pi * h * static_cast<double>(i + 1));
    std::vector<double> upper(nodes);
    for (long n = 0; n < steps; ++n) {
        for (std::size_t i = 0; i < nodes; ++i) {
            const double pivot = 1.0 + 2.0 * r + (i > 0 ? r * upper[i - 1] : 0.0);
            upper[i] = -r / pivot;
            u[i] = (u[i] + (i > 0 ? r * u[i - 1] : 0.0)) / pivot;
        }
        for (std::size_t i = nodes - 1; i-- > 0;)
            u[i] -= upper[i] * u[i + 1];
    }
    double greatest = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < nodes; ++i) {
        const double x = h * static_cast<double>(i + 1);
        const double exact =
            std::exp(-0.1 * std::numbers::pi * std::numbers::pi) * std::sin(std::numbers::pi * x);
        greatest = std::max(greatest, std::abs(u[i] - exact));
        square += h * (u[i] - exact) * (u[i] - exact);
    }
    return {{"max", greatest}, {"L2", std::sqrt(square)}};
}

} // namespace

int main() {
    std::vector<tvbeam::Widths> grid;
    for (const int elements : {8, 16, 32, 64})
        for (const int steps : {40, 80, 160, 320})
            grid.push_back({.h = 1.0 / elements, .dt = 0.1 / steps});
    int wrong = 0;
    for (const auto& [name, analysis] : tvbeam::analyse(heat_errors, grid).errors) {
        const tvbeam::TwoTermFit& fit = *analysis.two_term;
        std::cout << name << ": order " << fit.model.p << " +- " << fit.p_uncertainty() << " in h, "
                  << fit.model.q << " +- " << fit.q_uncertainty() << " in dt\n";
        const bool right = fit.predicts() && std::abs(fit.model.p - 2.0) <= 0.05 &&
                           std::abs(fit.model.q - 1.0) <= 0.05;
        wrong += right ? 0 : 1;
    }
    return wrong;
}
