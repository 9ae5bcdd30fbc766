#include "core/time/time_levels.hpp"

#include <algorithm>
#include <utility>

namespace tvbeam {

namespace {

/// Steps whose amplitudes are evaluated together: what a tape of instructions costs by itself is
/// then shared by many.
constexpr std::int64_t block_size = 256;

} // namespace

TimeLevels::TimeLevels(const ProblemData& data, TimeScheme scheme, double final_time,
                       std::int64_t steps)
    : data_(data), scheme_(std::move(scheme)), final_time_(final_time), steps_(steps) {}

StepSources TimeLevels::at(std::int64_t n, std::int64_t count) {
    if (n < first_ || n >= first_ + count_)
        evaluate_from(n);
    const std::int64_t begin = (n - first_) * stages_;
    return {{times_.data() + begin, count * stages_},
            {amplitudes_.data() + begin * amplitudes_.rows(), amplitudes_.rows(), count * stages_}};
}

std::int64_t TimeLevels::available(std::int64_t n) {
    if (n < first_ || n >= first_ + count_)
        evaluate_from(n);
    return first_ + count_ - n;
}

void TimeLevels::evaluate_from(std::int64_t n) {
    const TimeScheme& scheme = scheme_.at_step(n);
    const std::int64_t last = n <= scheme_.history ? scheme_.history : steps_;
    first_ = n;
    count_ = std::min({block_size, last - n + 1, steps_ - n + 1});
    stages_ = static_cast<std::int64_t>(scheme.stages.size());
    times_.resize(count_ * stages_);
    for (std::int64_t k = 0; k < count_; ++k)
        for (std::int64_t i = 0; i < stages_; ++i) {
            const double fraction = scheme.stages[static_cast<std::size_t>(i)].fraction;
            times_(k * stages_ + i) =
                fraction == 1.0 ? time(n + k) : time(n + k - 1) + fraction * dt();
        }
    if (data_.amplitude_count > 0)
        amplitudes_ = data_.amplitudes(times_);
    else
        amplitudes_.resize(0, times_.size());
}

} // namespace tvbeam
