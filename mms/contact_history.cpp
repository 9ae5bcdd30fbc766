#include "mms/contact_history.hpp"

#include "mms/admissible/sampled_rules.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/piecewise_tape.hpp"
#include "mms/expression/symbols.hpp"
#include "mms/largest_size.hpp"
#include "mms/local_power.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using GiNaC::ex;

namespace {

constexpr double nothing = 1e-9; ///< of the greatest size of a thing

/// A formula in t and its derivatives up to an order.
void append_with_derivatives(std::vector<ex>& rows, ex formula, int highest) {
    for (int order = 0; order <= highest; ++order) {
        rows.push_back(formula);
        if (order < highest)
            formula = derivative(formula, model_symbols().t);
    }
}

enum class Contact { none, rest, force };

class History {
public:
    /// highest: of the derivatives in time.
    History(const DerivedSolution& solution, const Stops& stops, double final_time, int highest)
        : stops_(stops),
          tape_(solution,
                [highest](const DerivedPhase& phase) {
                    std::vector<ex> rows;
                    append_with_derivatives(rows, substituted(phase.u, {{model_symbols().x, 1}}),
                                            highest);
                    append_with_derivatives(rows, phase.contact_stress, highest);
                    return rows;
                }),
          force_row_(highest + 1) {
        for (std::size_t i = 0; i < solution.phases.size(); ++i) {
            const PhaseExpressions& phase = solution.phases[i];
            const double end = std::min(phase.end_value, final_time);
            if (phase.begin_value < final_time)
                phases_.push_back(
                    {phase.begin_value, end,
                     telling_times(tape_.of_phase(i), {0, force_row_}, phase.begin_value, end)});
        }
        for (const Interval& phase : phases_)
            for (const double t : phase.times) {
                tip_size_ = std::max(tip_size_, std::abs(tip(phase, t)));
                force_size_ = std::max(force_size_, std::abs(value(phase, t, force_row_)));
            }
    }

    ContactHistory run() {
        for (const Interval& phase : phases_)
            contacts_.push_back(contact_of(phase));
        for (std::size_t i = 0; i < phases_.size(); ++i) {
            if (contacts_[i] == Contact::force) {
                result_.pressed_until = phases_[i].end;
                if (!result_.within)
                    result_.within = change_within(phases_[i]);
            } else
                seek_touch(i);
            if (i > 0 && contacts_[i] == Contact::force && contacts_[i - 1] != Contact::force)
                result_.onsets.push_back(
                    {phases_[i].begin, power(phases_[i - 1], phases_[i].begin, 0, 1, tip_size_),
                     power(phases_[i], phases_[i].begin, force_row_, 0, force_size_)});
        }
        return result_;
    }

    [[nodiscard]] ReachedStops reached() const {
        ReachedStops result;
        for (const Interval& phase : phases_) {
            result.lower = result.lower || reaches(phase, Stop::lower);
            result.upper = result.upper || reaches(phase, Stop::upper);
        }
        return result;
    }

private:
    struct Interval {
        double begin, end;
        ArrayXd times; ///< telling_times
    };
    enum class Stop { lower, upper };

    /// A time that begins a phase is read in it.
    [[nodiscard]] double value(const Interval& phase, double t, Index row) const {
        return tape_.at(ArrayXd::Zero(1), t, t == phase.begin)(row, 0);
    }
    [[nodiscard]] double tip(const Interval& phase, double t) const { return value(phase, t, 0); }

    /// Distance of the tip from a stop; of an admissible solution ≥ 0.
    [[nodiscard]] double gap(const Interval& phase, double t, Stop stop) const {
        const double u = tip(phase, t);
        return stop == Stop::upper ? stops_.upper - u : u - stops_.lower;
    }
    [[nodiscard]] bool is_on_stop(const Interval& phase, double t, Stop stop) const {
        return gap(phase, t, stop) <= nothing * tip_size_;
    }
    [[nodiscard]] bool is_on_stop(const Interval& phase, double t) const {
        return is_on_stop(phase, t, Stop::lower) || is_on_stop(phase, t, Stop::upper);
    }

    [[nodiscard]] Contact contact_of(const Interval& phase) const {
        const auto presses = [&](double t) {
            return std::abs(value(phase, t, force_row_)) > nothing * force_size_;
        };
        if (std::any_of(phase.times.begin(), phase.times.end(), presses))
            return Contact::force;
        const bool rests = std::all_of(phase.times.begin(), phase.times.end(),
                                       [&](double t) { return is_on_stop(phase, t); });
        return rests ? Contact::rest : Contact::none;
    }

    /// An end of a phase without a force is a touch unless a force ends or begins there.
    void seek_touch(std::size_t i) {
        if (result_.touch)
            return;
        const Interval& phase = phases_[i];
        const auto forced = [&](std::size_t k) { return contacts_[k] == Contact::force; };
        const bool after_force = i > 0 && forced(i - 1);
        const bool before_force = i + 1 < phases_.size() && forced(i + 1);
        std::size_t rest = i; // where one begins, if any does
        if (contacts_[i] == Contact::rest || (!after_force && is_on_stop(phase, phase.begin))) {
            result_.touch = phase.begin;
        } else if (!before_force && is_on_stop(phase, phase.end)) {
            result_.touch = phase.end;
            ++rest;
        } else {
            result_.touch = touch_inside(phase);
        }
        for (; rest < phases_.size() && contacts_[rest] == Contact::rest; ++rest)
            result_.rests_until = phases_[rest].end;
    }

    /// Where a gap that falls and rises again is least.
    template <typename Gap>
    static double least_between(const Gap& gap, double left, double right) {
        constexpr int thirds = 80;
        for (int step = 0; step < thirds; ++step) {
            const double third = (right - left) / 3.0;
            if (gap(left + third) < gap(right - third))
                right -= third;
            else
                left += third;
        }
        return 0.5 * (left + right);
    }

    [[nodiscard]] bool reaches(const Interval& phase, Stop stop) const {
        return is_on_stop(phase, phase.begin, stop) || is_on_stop(phase, phase.end, stop) ||
               touch_between(phase, stop, phase.begin, phase.end);
    }

    /// Where a tip that is on a stop leaves it on the way to another time, to rounding; around a
    /// flat touch such times are far from it, and as far on both sides.
    [[nodiscard]] double last_on_stop(const Interval& phase, double on, double away) const {
        if (is_on_stop(phase, away))
            return on;
        constexpr int halvings = 60;
        for (int step = 0; step < halvings; ++step) {
            const double middle = 0.5 * (on + away);
            (is_on_stop(phase, middle) ? on : away) = middle;
        }
        return on;
    }

    /// Where the tip comes to a stop, or leaves it; or rests there without a force for a while: one
    /// that begins with a power up to nine is nothing at fewer sampled times than these.
    [[nodiscard]] std::optional<double> change_within(const Interval& phase) const {
        constexpr double rounding = 1e-14;
        constexpr int fewest_of_a_rest = 8;
        const ArrayXd& times = phase.times;
        int resting = 0;
        for (Index k = 0; k + 1 < times.size(); ++k) {
            const bool rests =
                std::abs(value(phase, times(k), force_row_)) <= rounding * force_size_;
            if (!rests && resting >= fewest_of_a_rest)
                return times(k);
            resting = rests ? resting + 1 : 0;
            const bool comes_to_it = is_on_stop(phase, times(k + 1));
            if (is_on_stop(phase, times(k)) != comes_to_it)
                return comes_to_it ? last_on_stop(phase, times(k + 1), times(k))
                                   : last_on_stop(phase, times(k), times(k + 1));
        }
        return resting >= fewest_of_a_rest ? std::optional(times(times.size() - resting))
                                           : std::nullopt;
    }

    /// Where the gap to a stop has a minimum that is nothing, first after `begin` and before `end`.
    [[nodiscard]] std::optional<double> touch_between(const Interval& phase, Stop stop,
                                                      double begin, double end) const {
        if (!std::isfinite(stop == Stop::upper ? stops_.upper : stops_.lower))
            return std::nullopt;
        const ArrayXd& times = phase.times;
        const auto to_stop = [&](double t) { return gap(phase, t, stop); };
        const ArrayXd gaps = times.unaryExpr(to_stop);
        const Index last = times.size() - 1;
        for (Index k = 0; k <= last; ++k) {
            const Index before = std::max<Index>(k - 1, 0);
            const Index behind = std::min(k + 1, last);
            const bool is_flat = gaps(k) == gaps(before) && gaps(k) == gaps(behind);
            if (gaps(k) > gaps(before) || gaps(k) > gaps(behind) ||
                (is_flat && !is_on_stop(phase, times(k), stop)))
                continue;
            const double nearest = least_between(to_stop, times(before), times(behind));
            if (is_on_stop(phase, nearest, stop) && nearest > begin && nearest < end)
                return 0.5 * (last_on_stop(phase, nearest, times(before)) +
                              last_on_stop(phase, nearest, times(behind)));
        }
        return std::nullopt;
    }

    /// The first touch of either stop; next to an end on a stop it belongs to that end.
    [[nodiscard]] std::optional<double> touch_inside(const Interval& phase) const {
        const double apart = (phase.end - phase.begin) / static_cast<double>(time_points - 1);
        const double begin = phase.begin + (is_on_stop(phase, phase.begin) ? apart : 0.0);
        const double end = phase.end - (is_on_stop(phase, phase.end) ? apart : 0.0);
        const auto lower = touch_between(phase, Stop::lower, begin, end);
        const auto upper = touch_between(phase, Stop::upper, begin, end);
        return lower && upper ? std::min(lower, upper) : lower ? lower : upper;
    }

    /// The first power, from `least` on, with which a function leaves its value, or zero, at t: its
    /// derivative times the length of the phase is something. A fraction where that is infinite.
    [[nodiscard]] std::optional<double> power(const Interval& phase, double t, Index row, int least,
                                              double size) const {
        const double length = phase.end - phase.begin;
        const ArrayXXd values = tape_.at(ArrayXd::Zero(1), t, t == phase.begin);
        double factor = least == 0 ? 1.0 : length;
        for (int n = least; n <= highest_power; ++n) {
            if (n > 0 && !std::isfinite(values(row + n, 0)))
                return n - 1 + fraction(phase, t, row + n - 1, size / factor * length / n);
            if (std::abs(values(row + n, 0)) * factor > nothing * size)
                return n;
            factor *= length / (n + 1);
        }
        return std::nullopt;
    }

    /// The power below one with which a row goes to its value at an end of the phase.
    [[nodiscard]] double fraction(const Interval& phase, double t, Index row, double size) const {
        const double inwards = t == phase.begin ? 1.0 : -1.0;
        const double at_end = value(phase, t, row);
        const double beta = power_below_one(
            [&](double s) -> ArrayXd {
                return ArrayXd::Constant(1, value(phase, t + inwards * s, row) - at_end);
            },
            t, phase.end - phase.begin, size);
        return std::min(beta, 1.0);
    }

    Stops stops_;
    PiecewiseTape tape_;
    Index force_row_;
    std::vector<Interval> phases_;
    std::vector<Contact> contacts_;
    double tip_size_ = 0.0;
    double force_size_ = 0.0;
    ContactHistory result_;
};

} // namespace

ArrayXd telling_times(const Tape& tape, const std::vector<Index>& rows, double begin, double end) {
    const ArrayXd even = ArrayXd::LinSpaced(time_points, begin, end);
    std::vector<double> times(even.begin(), even.end());
    for (const Index row : rows) {
        const Tape alone = tape.only({row});
        const auto values_at = [&](const ArrayXd& x, const ArrayXd& t) -> ArrayXd {
            return alone.evaluate(x, t).row(0);
        };
        const ArrayXd values = values_at(ArrayXd::Ones(1), even);
        const ArrayXd seen = values.isFinite().select(values, 0.0);
        for (const double sign : {1.0, -1.0}) {
            const double most = (sign * seen).maxCoeff();
            const auto beyond = [&](const ArrayXd& x, const ArrayXd& t) -> ArrayXd {
                return (sign * values_at(x, t) - most).max(0.0);
            };
            const LargestPoint found = largest_point(beyond, {1.0, 1.0}, {begin, end});
            if (found.size > nothing * (found.size + seen.abs().maxCoeff()))
                times.push_back(found.t);
        }
    }
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return Eigen::Map<const ArrayXd>(times.data(), static_cast<Index>(times.size()));
}

ContactHistory contact_history(const DerivedSolution& solution, const Stops& stops,
                               double final_time) {
    return History(solution, stops, final_time, highest_power).run();
}

ReachedStops reached_stops(const DerivedSolution& solution, const Stops& stops, double final_time) {
    return History(solution, stops, final_time, 0).reached();
}

} // namespace tvbeam
