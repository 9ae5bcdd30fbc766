/// How long runs take, and how long a scheme takes to reach an error.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tvbeam {

/// The wall clock of repeated runs. Unit: s.
struct Timing {
    double min = 0.0;
    double q1 = 0.0; ///< lower quartile
    double median = 0.0;
    double q3 = 0.0;         ///< upper quartile
    int runs = 0;            ///< 1: there are no quartiles to speak of, all four are the same
    double clock_step = 0.0; ///< by which its clock may be off; see clock_step_of
    int at_zero = 0;         ///< runs of which the clock shows 0 s
};

/// Of one run or more. Quartiles lie between the sorted values as GSL has it: at (n − 1)/4 and
/// 3(n − 1)/4, counted from 0.
Timing timing_of(std::vector<double> seconds, double clock_step = 0.0);

/// The step of the clock that showed these times: a tick of an operating system's clock (1/60 s to
/// 1/1024 s) of which all are whole multiples, and that by no chance, as far as their decimals say;
/// or the greatest power of ten, from 1 s to 1 µs, again by no chance; but no less than the unit to
/// which they were printed, 0 where that is not known. 0 where they are neither. Unit: s.
double clock_step_of(const std::vector<double>& seconds, double printed_unit = 0.0);

/// What one run of a ladder gave.
struct TimedError {
    double error = 0.0; ///< a norm or its square; NaN where the run failed, or no time was seen
    Timing timing;
};

/// How near to the error of the coarsest or finest row is as good as that error: interpolated times
/// are no better, and an error may be written down with a few digits.
inline constexpr double same_error = 0.01;

/// The time that a scheme takes to reach an error, from the rows of its ladder, coarse to fine: on
/// the straight line between two neighbours in ln error and ln seconds, each of min, q1, median, q3
/// by itself; runs is the smaller of theirs, and the step of the clock is, as a part of the time,
/// the mean of theirs. None outside the range of the measured errors
/// (same_error apart): nothing is extrapolated.
///
/// Where the error rises along the ladder, it counts as reached only from where no finer row
/// exceeds it: a dip, by which two errors happen to cancel, is not a scheme's merit. Where a row
/// finer than that takes less time, its time counts. Nothing is interpolated across a row without
/// an error > 0, one that failed say.
std::optional<Timing> time_to_reach(std::span<const TimedError> rows, double error);

/// Two times for the same thing. Quartiles reach a step of their clock further: a time of t may be
/// of anything between t − step and t + step, as both its ends are seen late.
struct Comparison {
    double ratio = 1.0;           ///< median of the slower / median of the faster
    double lowest = 1.0;          ///< lower quartile of the slower / upper quartile of the faster
    double highest = 1.0;         ///< upper quartile of the slower / lower quartile of the faster
    double clock_step = 0.0;      ///< that of the two which is more of its time, from 1 % on
    bool first_is_faster = false; ///< by the medians
    /// The ratio is above 1.2 and the quartiles are disjoint; where one of the two is of one run,
    /// the ratio is above 2, as nothing says how that time scatters.
    bool distinguishable = false;
};

Comparison compare(const Timing& first, const Timing& second);

} // namespace tvbeam
