#pragma once

#include "core/contact/contact.hpp"
#include "core/space/linear_elements.hpp"
#include "core/time/time_levels.hpp"
#include "core/time/time_scheme.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace tvbeam {

/// What a run did; a part that the problem lacks leaves its counter at zero.
struct Counters {
    std::int64_t steps = 0;
    std::int64_t sine_steps = 0;       ///< of them in the sine basis
    std::int64_t heat_solves = 0;      ///< tridiagonal solves of the heat equation
    std::int64_t beam_solves = 0;      ///< updates of the curvature, or solves with the paper's B
    std::int64_t coupling_updates = 0; ///< exchanges between heat and beam; alpha = 0: none
    std::int64_t load_updates = 0;     ///< solves in which a heat source or a moment load was added
    std::int64_t source_evaluations =
        0; ///< sources evaluated on arrays of points: those that do not separate
    std::int64_t tip_evaluations = 0;        ///< tests of the tip against the stops; no stops: none
    std::int64_t contact_steps = 0;          ///< steps that end on a stop
    std::int64_t contact_changes = 0;        ///< solves with the tip on another stop, or on one or
                                             ///< none where it was not so in the solve before
    std::int64_t fixed_point_iterations = 0; ///< the paper's algorithm only
    std::int64_t norm_evaluations = 0;       ///< spatial error norms integrated
    std::int64_t integration_cells = 0;      ///< that the elements are cut into for quadrature
    std::int64_t doubles_allocated = 0;      ///< vectors held through the run, in doubles
};

/// What a caller will read of the solution; a field that nobody reads and nothing depends on is not
/// solved for.
struct Needs {
    bool temperature = true;
    bool deflection = true;
    bool curvature = false; ///< Solver::curvature() is called in every step

    /// What two readers need together.
    [[nodiscard]] Needs with(const Needs& other) const {
        return {temperature || other.temperature, deflection || other.deflection,
                curvature || other.curvature};
    }
};

/// One solve of a step, as it was asked for: y_t ≈ c (y − y*) at time t.
struct Solve {
    const TimeScheme* scheme;                            ///< the running one or its starter
    std::size_t stage;                                   ///< of the scheme
    double leading;                                      ///< c
    double t;                                            ///< where the sources were taken
    const Eigen::Ref<const Eigen::VectorXd>& amplitudes; ///< of the sources at t
};

/// One time stepper for (24)–(25) on one mesh, started at t = 0: the stages of a time scheme, each
/// a solve in space that the derived class makes.
class Solver {
public:
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;
    Solver(Solver&&) = delete;
    Solver& operator=(Solver&&) = delete;
    virtual ~Solver() = default;

    /// The next step; sources: at the times of its solves (TimeLevels). Returns an empty text, or
    /// why the step failed (not finite, fixed point without convergence); the state is then
    /// meaningless.
    std::string step(const StepSources& sources);

    /// Calls back after every solve that succeeds, the stages within a step included; the results
    /// below are then those of the solve. An empty function: never.
    void observe(std::function<void(const Solve&)> observer) { observer_ = std::move(observer); }

    /// Θ^n = Θ̃^n − θ_A (1 − x) at the nodes; shape: s + 1, zero at both ends. Empty when left out.
    [[nodiscard]] virtual Eigen::Ref<const Eigen::VectorXd> temperature() const = 0;

    /// U^n_xx at the ends of each element.
    [[nodiscard]] virtual DiscontinuousLinear curvature() const = 0;

    /// Contact stress σ̃ of the last solve: ≥ 0 at g1, ≤ 0 at g2, 0 between (7)(8). Unit: force.
    [[nodiscard]] double contact_stress() const { return stress_; }

    /// u(1, t) of the state, integrated from it.
    [[nodiscard]] virtual double tip_displacement() const = 0;

    [[nodiscard]] const Counters& counters() const { return counters_; }

protected:
    Solver(TimeScheme time, double dt) : time_(std::move(time)), dt_(dt) {}

    /// Solves the discrete equations at time t, with y_t replaced by c (y − y*): reads y* from
    /// state_ and leaves y there, and its contact stress in stress_.
    virtual std::string solve(double c, double t,
                              const Eigen::Ref<const Eigen::VectorXd>& amplitudes) = 0;

    Eigen::VectorXd state_; ///< all that the time derivative acts on; laid out by the derived class
    double stress_ = 0.0;
    Counters counters_;

private:
    TimeScheme time_;
    double dt_;
    PressedStop pressed_;
    std::function<void(const Solve&)> observer_;
    Eigen::VectorXd before_;     // y^{n−1}; empty where no stage reads an increment
    Eigen::MatrixXd increments_; // one column each, in the order of Stage::weights
};

} // namespace tvbeam
