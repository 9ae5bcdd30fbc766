#pragma once

#include "core/contact/contact.hpp"
#include "core/problem.hpp"
#include "core/run.hpp"
#include "core/scheme.hpp"
#include "core/sine/basis.hpp"
#include "core/sine/errors.hpp"
#include "core/sine/profiles.hpp"
#include "core/solver.hpp"
#include "core/time/time_levels.hpp"
#include "core/time/time_series.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace tvbeam {

/// The moment form (MomentForm) in the sine basis: on a uniform mesh every matrix of the heat
/// equation is diagonal there, so that a step is a handful of operations a mode, with no recurrence
/// over the mesh, and the modes march through a block of steps on their own (kernel.hpp).
///
/// Contact couples them. A block is marched with λ = 0 first; where its tip passes a stop, the
/// contact stresses follow one after the other from the free tips and the responses
/// ρ_i = the tip i solves after a solve with λ = 1,
///
///     u_m(1) = free_m + Σ_{i ≤ m} ρ_{m−i} λ_i,
///
/// each the exact solution of the scalar variational inequality of its solve, and the block is
/// marched again with them.
class SineForm {
public:
    /// Whether a run can be done in this form: a uniform mesh with a fast transform, sources that
    /// are sums of products, as the exact solution is, and cells only where SineErrors does not
    /// mind.
    static bool suits(const ProblemData& data, const Mesh& mesh, const Scheme& scheme,
                      const std::vector<Norm>& norms);

    /// data and norms must outlive the object.
    SineForm(const Beam& beam, const ProblemData& data, const Mesh& mesh, const Scheme& scheme,
             double final_time, std::int64_t steps, const std::vector<Norm>& norms,
             const Needs& needs);

    /// Whether the sums of sines would lose digits that the nodal form has
    /// (SineProfiles::peaks_at_node).
    [[nodiscard]] bool loses_digits() const { return profiles_.peaks_at_node; }

    /// Marches to the end, and tells after every block how many steps it had (RunRequest::advance).
    /// Fails as soon as something is not finite; the general form can then say where and what.
    [[nodiscard]] RunStatus march(const std::function<bool(std::int64_t steps)>& advance);

    [[nodiscard]] std::vector<double> errors() const { return errors_.sums().values(); }
    [[nodiscard]] Counters counters() const;

private:
    /// One block of steps, by solve.
    struct Block {
        TimeSeries amplitudes; // a column an amplitude
        TimeSeries weights;    // c_r and c_arm
        TimeSeries changes;    // κ (−c* − μ + λ) by profile and for the moment arm
        TimeSeries loads;      // of the g_j
        Eigen::VectorXd stress;
        TimeSeries end_amplitudes; // these two by step, where a step has several solves
        TimeSeries end_weights;
        PackSums tip; // by solve
    };

    /// What a march of a block begins with.
    struct Start {
        const Eigen::MatrixXd& weights;
        const ModeArrays& modes;
        bool driven; // by the sources; the contact stress of the block always drives it
    };
    enum class Wanted { tips, end, tips_and_end };

    void find_sources();
    void find_initial_state(const Mesh& mesh);
    void make_room();
    void use(const TimeScheme& scheme);
    [[nodiscard]] Eigen::Index stages() const {
        return static_cast<Eigen::Index>(running_->stages.size());
    }
    void read_amplitudes(std::int64_t n, std::int64_t steps);
    [[nodiscard]] bool march_block(std::int64_t steps);
    void count(std::int64_t steps);
    void march_weights(std::int64_t solves, const Start& start);
    void step_weights(std::int64_t step);
    void step_weights_by_one_solve_each(std::int64_t solves);
    bool march_modes(std::int64_t steps, const Start& start, Wanted wanted);
    [[nodiscard]] Eigen::VectorXd tips(std::int64_t solves) const;
    bool find_contact(const Eigen::VectorXd& free_tips);
    void find_responses(std::int64_t solves);
    [[nodiscard]] const TimeSeries& at_step_ends(const TimeSeries& by_solve, TimeSeries& by_step,
                                                 std::int64_t steps) const;
    void weigh_errors(std::int64_t steps);
    void add_errors(std::int64_t steps);
    void remember_starting_step();

    Beam beam_;
    const ProblemData& data_;
    Scheme scheme_;
    bool heat_;
    bool bending_;
    bool coupled_;
    bool stops_;
    SineBasis basis_;
    SineProfiles profiles_;
    TimeLevels levels_;
    Eigen::Index most_steps_; // of a block
    SineErrors errors_;
    std::vector<Eigen::Index> amplitudes_; // those that are read
    Eigen::MatrixXd moment_;               // μ_r by amplitude; shape: amplitudes × (R + 1)
    Eigen::MatrixXd heat_source_;          // f in the g_j by amplitude; shape: amplitudes × J
    Eigen::MatrixXd change_loads_;         // what a change loads the g_j with; shape: (R + 1) × J

    const TimeScheme* running_ = nullptr; // the scheme itself or its starter
    double leading_ = 0.0;
    double kappa_ = 0.0;
    ModeArrays operators_;              // K, then 1/(cM + K + α²cκ)
    Eigen::MatrixXd increment_weights_; // of the running scheme; shape: increments × stages
    Eigen::MatrixXd responses_; // ρ by stage of λ; shape: solves × stages; empty until needed

    ModeArrays state_; // θ, a, then their increments
    ModeArrays next_;
    Eigen::MatrixXd weights_; // c_r and c_arm, then their increments, by column
    Eigen::MatrixXd next_weights_;
    std::vector<Eigen::Index> moving_; // weights that are not zero for ever
    Block block_;
    bool in_contact_ = false;
    PressedStop pressed_;
    Counters counters_;
};

} // namespace tvbeam
