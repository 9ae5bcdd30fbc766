#pragma once

#include "core/certify/piecewise_linear.hpp"
#include "core/certify/stated_scheme.hpp"
#include "core/problem.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace tvbeam {

/// What a solver shows of a state.
struct SolverState {
    Eigen::VectorXd theta;   ///< Θ at the nodes, θ̃ − θ_A (1 − x); shape: s + 1
    certify::BrokenLinear w; ///< U_xx; shape: 2 × s
    double stress = 0.0;     ///< λ: ≥ 0 at g1, ≤ 0 at g2
};

/// A state as it is recorded, in units of the record.
struct RecordedState {
    Eigen::VectorXd theta;
    certify::BrokenLinear w;

    // The sizes, in the largest norm, of what the results are the sums of; round-off is ε times
    // them. With a strong coupling w is a small difference of large terms, and a state that decays
    // in one step is its increment away from the state before.
    /// |Θ| + |Θ*| + |λ| ακ c/(c + π²): a reaction takes away a part of Θ that would be there
    /// without it, and that is as large as the one that the force λ drives alone.
    double temperature_size = 0.0;
    double terms_size = 0.0; ///< P = (1 − κ) P* + κF, F = α(|Θ| + |Θ*| + |θ_A|) + |Πμ| + |λ|
    double curvature_size = 0.0; ///< (1 − κ) curvature_size* + P* + κF: the round-off of w

    [[nodiscard]] bool is_finite() const { return theta.allFinite() && w.allFinite(); }
};

/// One solve seen from outside: what the two discrete equations
///
///     cM(Θ − Θ*) + KΘ − αc (w − w*, χ) = (f, χ)
///     w + ζc (w − w*) + α (Θ + θ_A(1 − x)) + Πμ − λ (1 − x) = 0
///
/// consist of. c and y* are those of the scheme as the literature states it; the loads are those of
/// the problem at the times that it states.
struct SolveRecord {
    StatedStep step;
    Eigen::Index stage = 0;
    double leading = 0.0; ///< c
    double dt = 0.0;
    double unit = 1.0; ///< of everything below (RecordOptions)
    RecordedState now;
    RecordedState star;
    Eigen::VectorXd heat_load;    ///< (f, χ_i); shape: s + 1
    certify::BrokenLinear moment; ///< Πμ
    double stress = 0.0;          ///< λ
};

/// How a solver's results are read.
struct RecordOptions {
    double unit = 1.0; ///< everything linear in the data is divided by it: a power of two
    /// The least size of the curvature, where an iteration leaves a part of the unit in it that
    /// does not decay with it.
    double least_size = 0.0;
};

/// Records the solves of a run by the results alone: record() each of them.
class SolveRecorder {
public:
    /// data and mesh must outlive the object. scheme: a name of stated_step.
    SolveRecorder(const Beam& beam, const ProblemData& data, const Mesh& mesh, std::string scheme,
                  double dt, const RecordOptions& options, SolverState initial);
    SolveRecorder(const Beam& beam, const ProblemData& data, Mesh&& mesh, std::string scheme,
                  double dt, const RecordOptions& options, SolverState initial) = delete;

    /// The next solve of the step. One that the scheme does not have is recorded as its last.
    const SolveRecord& record(SolverState state);

    /// y^{n−1} of the step that the last record belongs to; of a two-step formula also y^{n−2}.
    [[nodiscard]] const RecordedState& before(std::size_t steps = 1) const;

    /// Y_i of the step that the last record belongs to, i < its solves, until it ends.
    [[nodiscard]] const RecordedState& stage(Eigen::Index i) const;

    /// Call when the step has ended; its records are then no longer there. Returns an empty text,
    /// or how its solves differ in number from those of the scheme.
    std::string end_step();

private:
    [[nodiscard]] RecordedState in_units(SolverState state) const;
    void read_loads(double t);
    void read_star();
    [[nodiscard]] RecordedState last_state();

    const Beam beam_;
    const ProblemData& data_;
    const Mesh& mesh_;
    const std::string scheme_;
    RecordOptions options_;
    // By profile; of one that no source has, empty.
    std::vector<Eigen::VectorXd> heat_loads_;
    std::vector<certify::BrokenLinear> moments_;
    std::vector<RecordedState> levels_; // y^{n−1}, y^{n−2}, …
    std::vector<RecordedState> stages_; // of this step, without the last, which is record_.now
    std::int64_t n_ = 1;
    Eigen::Index made_ = 0; // solves of this step
    SolveRecord record_;
};

} // namespace tvbeam
