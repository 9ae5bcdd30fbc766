#pragma once

#include "mms/derivation.hpp"
#include "mms/expression/tape.hpp"

#include <ginac/ginac.h>

#include <functional>
#include <vector>

namespace tvbeam {

/// Several functions of x and t that a solution gives, each with one formula a phase, as tapes.
class PiecewiseTape {
public:
    /// formulas: those of one phase. Throws AlgebraError as compile_tape does.
    PiecewiseTape(const DerivedSolution& solution,
                  const std::function<std::vector<GiNaC::ex>(const DerivedPhase&)>& formulas);

    /// Their values at the points x at one time; shape: one row a function. A time that ends a
    /// phase belongs to it; `late`: to the phase that begins there.
    [[nodiscard]] Eigen::ArrayXXd at(const Eigen::ArrayXd& x, double t, bool late = false) const;

    /// At one time after the other, as in point_grid; none is late.
    [[nodiscard]] Eigen::ArrayXXd at_all(const Eigen::ArrayXd& x,
                                         const Eigen::ArrayXd& times) const;

    /// Those of one phase, at any time.
    [[nodiscard]] const Tape& of_phase(std::size_t phase) const { return tapes_[phase]; }

private:
    [[nodiscard]] std::size_t phase_of(double t, bool late) const;

    std::vector<double> ends_;
    std::vector<Tape> tapes_;
};

} // namespace tvbeam
