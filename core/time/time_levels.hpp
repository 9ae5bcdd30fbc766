#pragma once

#include "core/problem.hpp"
#include "core/time/time_scheme.hpp"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>

namespace tvbeam {

/// What the solves of one step, or of several in a row, read of the sources: an entry a solve.
struct StepSources {
    Eigen::Map<const Eigen::ArrayXd> times;
    Eigen::Map<const Eigen::MatrixXd> amplitudes; ///< shape: ProblemData::amplitude_count × solves
};

/// The time levels t_n = T n/N of a run and the amplitudes of the sources at the times of its
/// solves, evaluated a block of steps at a time.
///
/// The sources may jump from one phase to the next, where one ulp decides: in doubles 0.4 · 3/4 is
/// greater than 0.3. A level is therefore the double nearest to T n/N, T being the decimal that it
/// is written as (one ulp off it where T N in units of T's last digit is beyond 2^53); and a level
/// or the time of a stage that is the end of a phase to round-off is that end.
class TimeLevels {
public:
    /// data must outlive the object.
    TimeLevels(const ProblemData& data, TimeScheme scheme, double final_time, std::int64_t steps);

    [[nodiscard]] double time(std::int64_t n) const { return at_phase_end(level(n)); }
    [[nodiscard]] double dt() const { return final_time_ / static_cast<double>(steps_); }
    [[nodiscard]] std::int64_t steps() const { return steps_; }

    /// Whether one of the levels is t, the end of a phase.
    [[nodiscard]] bool meet(double t) const { return time(std::llround(t / dt())) == t; }

    /// The sources of steps n … n + count − 1; valid until the next call. At most
    /// `available(n)` steps.
    StepSources at(std::int64_t n, std::int64_t count = 1);

    /// How many steps from n on share a block and a scheme; n ≤ N.
    std::int64_t available(std::int64_t n);

private:
    /// T n/N, rounded.
    [[nodiscard]] double level(std::int64_t n) const {
        return numerator_ * static_cast<double>(n) / denominator_;
    }
    void find_fraction();
    [[nodiscard]] double at_phase_end(double t) const;
    void evaluate_from(std::int64_t n);

    const ProblemData& data_;
    TimeScheme scheme_;
    double final_time_;
    std::int64_t steps_;
    double numerator_; // these two: T/N as a fraction
    double denominator_;
    std::int64_t first_ = 0; // the first step of the block
    std::int64_t count_ = 0; // steps in the block
    std::int64_t stages_ = 1;
    Eigen::ArrayXd times_;
    Eigen::ArrayXXd amplitudes_;
};

} // namespace tvbeam
