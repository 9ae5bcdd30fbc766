#pragma once

#include "core/problem.hpp"
#include "core/solver.hpp"
#include "core/space/linear_elements.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tvbeam {

/// A state as a solver's results show it: Solver::temperature() and Solver::curvature().
struct RecordedState {
    Eigen::VectorXd theta; ///< Θ at the nodes; shape: s + 1
    DiscontinuousLinear w; ///< U_xx; shape: 2 × s

    // The sizes, in the largest norm, of what the results are the sums of; round-off is ε times
    // them. With a strong coupling w is a small difference of large terms, and a state that decays
    // in one step is its increment away from the state before.
    double temperature_size = 0.0; ///< |Θ| + |Θ*|
    double terms_size = 0.0; ///< P = (1 − κ) P* + κF, F = α(|Θ| + |Θ*| + |θ_A|) + |Πμ| + |λ|
    double curvature_size = 0.0; ///< (1 − κ) curvature_size* + P* + κF: the round-off of w
};

/// One solve seen from outside: what the two discrete equations
///
///     cM(Θ − Θ*) + KΘ − αc (w − w*, χ) = (f, χ)
///     w + ζc (w − w*) + α (Θ + θ_A(1 − x)) + Πμ − λ (1 − x) = 0
///
/// consist of. y* is combined anew from recorded results; loads are projected anew.
struct SolveRecord {
    const TimeScheme* scheme = nullptr; ///< the running one or its starter
    std::size_t stage = 0;
    double leading = 0.0; ///< c
    double dt = 0.0;
    double unit = 1.0; ///< of everything below (RecordOptions)
    RecordedState now;
    RecordedState star;
    Eigen::VectorXd heat_load;  ///< (f, χ_i); shape: s + 1
    DiscontinuousLinear moment; ///< Πμ
    double stress = 0.0;        ///< λ
};

/// How a solver's results are read.
struct RecordOptions {
    double unit = 1.0; ///< everything linear in the data is divided by it: a power of two
    /// By how much the round-off of the curvature is larger than ε times its terms: 1, or that of
    /// the Hermite form.
    double amplification = 1.0;
    /// What an iteration leaves in the curvature, in units of ε.
    double iteration_size = 0.0;
};

/// Reads the records of a run: observe() each solve.
class SolveRecorder {
public:
    /// At the initial state of the solver. data and solver must outlive the object.
    SolveRecorder(const Beam& beam, const ProblemData& data, const Mesh& mesh, const Solver& solver,
                  double dt, const RecordOptions& options);

    /// The solve that the solver has just made.
    const SolveRecord& record(const Solve& solve);

    /// y^{n−1}, y^{n−2}, … of the step that the last record belongs to.
    [[nodiscard]] const RecordedState& before(std::size_t steps = 1) const;

    /// Call when the step has ended.
    void end_step();

private:
    struct Load {
        Eigen::VectorXd hat;            // (φ, χ_i); empty: not a heat source
        DiscontinuousLinear projection; // Πφ; empty: not in μ
    };
    void read_loads(const Solve& solve);
    void read_star(const Solve& solve);

    const Beam beam_;
    const ProblemData& data_;
    const Mesh mesh_;
    const Solver& solver_;
    RecordOptions options_;
    std::vector<Load> loads_;
    std::vector<RecordedState> levels_; // y^{n−1}, y^{n−2}, …
    std::vector<RecordedState> stages_; // of this step
    SolveRecord record_;
};

} // namespace tvbeam
