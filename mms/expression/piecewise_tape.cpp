#include "mms/expression/piecewise_tape.hpp"

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

Eigen::ArrayXXd PiecewiseTape::at(const Eigen::ArrayXd& x, double t, bool late) const {
    std::size_t phase = 0;
    while (phase + 1 < ends_.size() && (t > ends_[phase] || (late && t == ends_[phase])))
        ++phase;
    return tapes_[phase].evaluate(x, Eigen::ArrayXd::Constant(1, t));
}

} // namespace tvbeam
