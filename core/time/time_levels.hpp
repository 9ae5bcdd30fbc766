#pragma once

#include "core/problem.hpp"
#include "core/time/time_scheme.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace tvbeam {

/// What the solves of one step, or of several in a row, read of the sources: an entry a solve.
struct StepSources {
    Eigen::Map<const Eigen::ArrayXd> times;
    Eigen::Map<const Eigen::MatrixXd> amplitudes; ///< shape: ProblemData::amplitude_count × solves
};

/// The time levels t_n = T n/N of a run and the amplitudes of the sources at the times of its
/// solves, evaluated a block of steps at a time.
class TimeLevels {
public:
    /// data must outlive the object.
    TimeLevels(const ProblemData& data, TimeScheme scheme, double final_time, std::int64_t steps);

    [[nodiscard]] double time(std::int64_t n) const {
        return final_time_ * static_cast<double>(n) / static_cast<double>(steps_);
    }
    [[nodiscard]] double dt() const { return final_time_ / static_cast<double>(steps_); }
    [[nodiscard]] std::int64_t steps() const { return steps_; }

    /// The sources of steps n … n + count − 1; valid until the next call. At most
    /// `available(n)` steps.
    StepSources at(std::int64_t n, std::int64_t count = 1);

    /// How many steps from n on share a block and a scheme; n ≤ N.
    std::int64_t available(std::int64_t n);

private:
    void evaluate_from(std::int64_t n);

    const ProblemData& data_;
    TimeScheme scheme_;
    double final_time_;
    std::int64_t steps_;
    std::int64_t first_ = 0; // the first step of the block
    std::int64_t count_ = 0; // steps in the block
    std::int64_t stages_ = 1;
    Eigen::ArrayXd times_;
    Eigen::ArrayXXd amplitudes_;
};

} // namespace tvbeam
