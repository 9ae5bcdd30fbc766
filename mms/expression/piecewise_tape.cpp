#include "mms/expression/piecewise_tape.hpp"

#include "core/point_grid.hpp"
#include "mms/expression/tape_compiler.hpp"

namespace tvbeam {

PiecewiseTape::PiecewiseTape(
    const DerivedSolution& solution,
    const std::function<std::vector<GiNaC::ex>(const DerivedPhase&)>& formulas) {
    for (std::size_t i = 0; i < solution.phases.size(); ++i) {
        ends_.push_back(solution.phases[i].end_value);
        tapes_.push_back(compile_tape(formulas(solution.derived[i])));
    }
}

std::size_t PiecewiseTape::phase_of(double t, bool late) const {
    std::size_t phase = 0;
    while (phase + 1 < ends_.size() && (t > ends_[phase] || (late && t == ends_[phase])))
        ++phase;
    return phase;
}

Eigen::ArrayXXd PiecewiseTape::at(const Eigen::ArrayXd& x, double t, bool late) const {
    return tapes_[phase_of(t, late)].evaluate(x, Eigen::ArrayXd::Constant(1, t));
}

Eigen::ArrayXXd PiecewiseTape::at_all(const Eigen::ArrayXd& x, const Eigen::ArrayXd& times) const {
    Eigen::ArrayXXd values;
    for (Eigen::Index first = 0, count = 0; first < times.size(); first += count) {
        const std::size_t phase = phase_of(times(first), false);
        count = 1;
        while (first + count < times.size() && phase_of(times(first + count), false) == phase)
            ++count;
        const Points points = point_grid(x, times.segment(first, count));
        Eigen::ArrayXXd of_phase = tapes_[phase].evaluate(points.x, points.t);
        if (count == times.size())
            return of_phase;
        values.resize(of_phase.rows(), x.size() * times.size()); // nothing, but at first
        values.middleCols(first * x.size(), points.x.size()) = of_phase;
    }
    return values;
}

} // namespace tvbeam
