#include "core/solver.hpp"

#include <cmath>

namespace tvbeam {

std::string Solver::step(const StepSources& sources) {
    ++counters_.steps;
    const TimeScheme& scheme = time_.at_step(counters_.steps);
    const Eigen::Index first_stage = time_.first_stage_increment(scheme);
    const bool remembers = time_.increments() > 0;
    if (remembers) {
        if (increments_.size() == 0) {
            increments_ = Eigen::MatrixXd::Zero(state_.size(), time_.increments());
            counters_.doubles_allocated += increments_.size() + state_.size();
        }
        before_ = state_;
    }
    const std::size_t stages = scheme.stages.size();
    for (std::size_t i = 0; i < stages; ++i) {
        const Stage& stage = scheme.stages[i];
        if (i > 0)
            state_ = before_;
        for (std::size_t j = 0; j < stage.weights.size(); ++j) {
            const auto read = static_cast<Eigen::Index>(j);
            state_ +=
                stage.weights[j] *
                increments_.col(read < scheme.history ? read : first_stage + read - scheme.history);
        }
        const auto column = static_cast<Eigen::Index>(i);
        const double c = stage.leading / dt_;
        const Eigen::Ref<const Eigen::VectorXd> amplitudes = sources.amplitudes.col(column);
        std::string reason = solve(c, sources.times(column), amplitudes);
        if (!reason.empty())
            return reason;
        counters_.contact_changes += pressed_.changes(stress_) ? 1 : 0;
        if (observer_)
            observer_({&scheme, i, c, sources.times(column), amplitudes});
        if (i + 1 < stages)
            increments_.col(first_stage + column) = state_ - before_;
    }
    for (Eigen::Index j = time_.history - 1; j > 0; --j)
        increments_.col(j) = increments_.col(j - 1);
    if (time_.history > 0)
        increments_.col(0) = state_ - before_;
    if (stress_ != 0.0)
        ++counters_.contact_steps;
    return {};
}

} // namespace tvbeam
