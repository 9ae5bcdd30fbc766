#include "core/time/time_levels.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tvbeam {

namespace {

/// Steps whose amplitudes are evaluated together: what a tape of instructions costs by itself is
/// then shared by many.
constexpr std::int64_t block_size = 256;

/// Up to here doubles hold every whole number.
constexpr double most_exact = 0x1p53;

} // namespace

TimeLevels::TimeLevels(const ProblemData& data, TimeScheme scheme, double final_time,
                       std::int64_t steps)
    : data_(data), scheme_(std::move(scheme)), final_time_(final_time), steps_(steps),
      numerator_(final_time), denominator_(static_cast<double>(steps)) {
    find_fraction();
}

/// T = r/10^q with the smallest q. As long as r N and 10^q N are whole numbers that doubles hold
/// exactly, the division is all that rounds in (r n)/(10^q N).
void TimeLevels::find_fraction() {
    const auto steps = static_cast<double>(steps_);
    for (double scale = 1.0; scale * steps < most_exact; scale *= 10.0) {
        const double whole = std::round(final_time_ * scale);
        if (whole * steps >= most_exact)
            return;
        if (whole / scale == final_time_) {
            numerator_ = whole;
            denominator_ = scale * steps;
            return;
        }
    }
}

/// The end of a phase that t is to round-off, or t itself. With the unit round-off u = ε/2 each of
/// T, T/N, γΔt, their products and sums is off by u, relative to at most t, and so is the end: a
/// dozen together, or two more where T is itself N times a step. A step is never less than 1e-12 T.
double TimeLevels::at_phase_end(double t) const {
    const double near = 8.0 * std::numeric_limits<double>::epsilon() * t;
    const auto& ends = data_.phase_ends;
    const auto end = std::lower_bound(ends.begin(), ends.end(), t - near);
    return end != ends.end() && *end <= t + near ? *end : t;
}

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
    // Few blocks meet the end of a phase.
    const auto& ends = data_.phase_ends;
    const auto end = std::lower_bound(ends.begin(), ends.end(), level(n - 1) - dt());
    const bool meets_end = end != ends.end() && *end <= level(n + count_ - 1) + dt();
    const auto moved = [&](double t) { return meets_end ? at_phase_end(t) : t; };
    for (std::int64_t k = 0; k < count_; ++k)
        for (std::int64_t i = 0; i < stages_; ++i) {
            const double fraction = scheme.stages[static_cast<std::size_t>(i)].fraction;
            times_(k * stages_ + i) =
                moved(fraction == 1.0 ? level(n + k) : moved(level(n + k - 1)) + fraction * dt());
        }
    if (data_.amplitude_count > 0)
        amplitudes_ = data_.amplitudes(times_);
    else
        amplitudes_.resize(0, times_.size());
}

} // namespace tvbeam
