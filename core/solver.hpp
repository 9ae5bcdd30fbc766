#pragma once

#include "core/linear_elements.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>

namespace tvbeam {

/// What a run did; a part that the problem lacks leaves its counter at zero.
struct Counters {
    std::int64_t steps = 0;
    std::int64_t heat_solves = 0;      ///< tridiagonal solves of the heat equation
    std::int64_t beam_solves = 0;      ///< updates of the curvature, or solves with the paper's B
    std::int64_t coupling_updates = 0; ///< exchanges between heat and beam; alpha = 0: none
    std::int64_t load_updates = 0;     ///< steps in which a heat source or a moment load was added
    std::int64_t source_evaluations =
        0; ///< sources evaluated on arrays of points: those that do not separate
    std::int64_t tip_evaluations = 0;        ///< tests of the tip against the stops; no stops: none
    std::int64_t contact_steps = 0;          ///< steps that end on a stop
    std::int64_t fixed_point_iterations = 0; ///< the paper's algorithm only
    std::int64_t norm_evaluations = 0;       ///< spatial error norms integrated
    std::int64_t doubles_allocated = 0;      ///< vectors held through the run, in doubles
};

/// What a caller will read of the solution; a field that nobody reads and nothing depends on is not
/// solved for.
struct Needs {
    bool temperature = true;
    bool deflection = true;
    bool curvature = false; ///< Solver::curvature() is called in every step
};

/// One time stepper for (24)–(25) on one mesh, started at t = 0.
class Solver {
public:
    Solver() = default;
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;
    Solver(Solver&&) = delete;
    Solver& operator=(Solver&&) = delete;
    virtual ~Solver() = default;

    /// One step to t; amplitudes: those of ProblemData at t. Returns an empty text, or why the step
    /// failed (not finite, fixed point without convergence); the state is then meaningless.
    virtual std::string step(double t, const Eigen::Ref<const Eigen::VectorXd>& amplitudes) = 0;

    /// Θ^n = Θ̃^n − θ_A (1 − x) at the nodes; shape: s + 1, zero at both ends. Empty when left out.
    [[nodiscard]] virtual const Eigen::VectorXd& temperature() const = 0;

    /// U^n_xx at the ends of each element.
    [[nodiscard]] virtual DiscontinuousLinear curvature() const = 0;

    /// Contact stress σ̃ of the last step: ≥ 0 at g1, ≤ 0 at g2, 0 between (7)(8). Unit: force.
    [[nodiscard]] virtual double contact_stress() const = 0;

    /// u(1, t) of the state, integrated from it.
    [[nodiscard]] virtual double tip_displacement() const = 0;

    [[nodiscard]] virtual const Counters& counters() const = 0;
};

} // namespace tvbeam
