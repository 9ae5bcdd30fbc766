// The paper's test problem as C++: the errors that the shipped text of it has.

#include "mms/autodiff_problem.hpp"
#include "studies/ladder/ladder.hpp"
#include "studies/study.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

namespace {

/// Copetti and Fernández (2011), Section 3.
struct CopettiFernandez {
    double g2;

    template <typename Real>
    Real theta(const Real& x, const Real& t) const {
        return exp(t) * sin(std::numbers::pi * x);
    }
    template <typename Real>
    Real u(const Real& x, const Real& t) const {
        const Real shape = -3.0 * g2 * (x * x * x / 6.0 - x * x / 2.0);
        if (t <= std::numbers::sqrt2)
            return shape * (std::numbers::sqrt2 * t - t * t / 2.0);
        return shape;
    }
    template <typename Real>
    Real sigma(const Real& t) const {
        if (t <= std::numbers::sqrt2)
            return 0.0;
        return -t;
    }
};

} // namespace

int main() {
    const tvbeam::Scene scene =
        tvbeam::read_scene("table1-consistent", {"ladder.elements=[10, 20]",
                                                 "ladder.dt=[0.05, 0.025]", "ladder.printed={}"});
    const auto problem = tvbeam::autodiff_problem(CopettiFernandez{scene.beam.stops.upper},
                                                  scene.beam, scene.longest_time());
    const tvbeam::StudyResult own = tvbeam::run_study(scene, problem);
    const tvbeam::StudyResult shipped = tvbeam::run_study(scene);
    const auto norms = scene.measures();
    const auto& mine = own.get<tvbeam::LadderResult>()->rungs;
    const auto& theirs = shipped.get<tvbeam::LadderResult>()->rungs;
    int differences = 0;
    for (std::size_t k = 0; k < norms.size(); ++k)
        for (std::size_t i = 0; i < mine.size(); ++i) {
            const double error = mine[i].errors.at(k);
            const double wanted = theirs[i].errors.at(k);
            std::cout << norms[k].name << ": " << error << ", shipped " << wanted
                      << ", relative difference " << std::abs(error - wanted) / wanted << '\n';
            differences += std::abs(error - wanted) <= 1e-10 * wanted ? 0 : 1;
        }
    return differences;
}
