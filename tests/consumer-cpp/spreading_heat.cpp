#include "mms/autodiff_problem.hpp"
#include "studies/gates/check.hpp"

#include <exception>
#include <iostream>

/// Heat spreads from the clamped end; the tip rises to the stop g2 and from t = 1 on presses on it.
struct SpreadingHeat {
    double g2;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        const Real width = 2.0 * sqrt(t + 0.1);
        return erf(x / width) - x * erf(1.0 / width);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        const Real held = g2 * x * x * (3.0 - x) / 2.0;
        return t <= 1.0 ? held * (1.0 - (1.0 - t) * (1.0 - t) * (1.0 - t)) : held;
    }
    template <typename Real>
    Real sigma(const Real& t) const {
        return t <= 1.0 ? Real(0.0) : -(t - 1.0) * (t - 1.0);
    }
};

int main() try {
    const auto scene =
        tvbeam::read_scene("spreading_heat.toml", {}, {.expectations = true, .own_problem = true});
    const SpreadingHeat solution{.g2 = scene.beam.stops.upper};
    const auto problem = tvbeam::autodiff_problem(solution, scene.beam, scene.longest_time());
    bool holds = true;
    for (const auto& one : tvbeam::check(tvbeam::run_study(scene, problem))) {
        std::cout << one.what << ": " << one.found << ", expected " << one.expected << '\n';
        holds = holds && one.holds;
    }
    return holds ? 0 : 1;
} catch (const std::exception& error) { // a mistake in the scene, say
    std::cerr << error.what() << '\n';
    return 2;
}
