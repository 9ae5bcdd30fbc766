#include "mms/admissible/sampled_rules.hpp"

#include "mms/text/error_text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

constexpr double level = 1.4;    // |s - a|^(-1/4) grows as much in a fourth of the width
constexpr int least_growths = 6; // of some 22; noise has set its records before
constexpr double least_growth = 1e3;
constexpr double narrowest_look = 1e-13; // narrower, the rounding of s - a is seen

/// The size of sample k, a greatest one, or where that stands far above those beside it, theirs: it
/// is a pole then but for rounding, and as large from afar as from near.
double size_off_pole(const ArrayXd& sizes, Index k) {
    constexpr double far_above = 1e2;
    const double before = k > 0 ? sizes(k - 1) : 0.0;
    const double beside = k + 1 < sizes.size() ? std::max(before, sizes(k + 1)) : before;
    return sizes(k) > far_above * beside ? beside : sizes(k);
}

/// What |g| does as a look closes in on a place.
struct CloserLook {
    double first;
    double largest = first;
    int growths = 0;

    /// Whether the greatest of a look is more than that of those before.
    bool add(double off_pole) {
        const bool grows = off_pole > level * largest;
        growths += grows ? 1 : 0;
        largest = std::max(largest, off_pole);
        return grows;
    }
    [[nodiscard]] bool is_bounded() const {
        return growths < least_growths || largest < least_growth * first;
    }
};

/// Where |g| grows towards a point between two, however near it is looked at, as at a pole; without
/// value where it does not.
///
/// @param largest |g| at a point between them, or next to it
std::optional<double> unbounded_between(const std::function<ArrayXd(const ArrayXd&)>& g,
                                        double begin, double end, double largest) {
    const double width = narrowest_look * std::max({std::abs(begin), std::abs(end), end - begin});
    CloserLook growth{largest};
    CloseLook look{begin, end};
    while (look.end - look.begin > width) {
        const ArrayXd s = look.samples();
        const ArrayXd sizes = g(s).abs();
        for (Index k = 0; k < s.size(); ++k)
            if (!std::isfinite(sizes(k)))
                return s(k);
        Index at = 0;
        const double greatest = sizes.maxCoeff(&at);
        const bool grows = growth.add(size_off_pole(sizes, at));
        if (!grows && greatest <= level * sizes.minCoeff())
            return std::nullopt;
        look = look.next_to(s(at), look.spacing());
    }
    return growth.is_bounded() ? std::nullopt : std::optional(std::midpoint(look.begin, look.end));
}

struct PlanePoint {
    double x, t;
};

/// As unbounded_between, of both variables at once: (x - a)^2 + (t - b)^2 is 0 at one point.
std::optional<PlanePoint> unbounded_beside(const SpaceTimeFunction& g, CloseLook in_x,
                                           CloseLook in_t, double largest) {
    CloserLook growth{largest};
    const double width_t = narrowest_look * in_t.end;
    while (in_x.end - in_x.begin > narrowest_look || in_t.end - in_t.begin > width_t) {
        const ArrayXd x = in_x.samples();
        const ArrayXd t = in_t.samples();
        ArrayXXd sizes(x.size(), t.size());
        for (Index j = 0; j < t.size(); ++j)
            sizes.col(j) = g(x, t(j)).abs();
        Index row = 0;
        Index column = 0;
        if (!sizes.isFinite().all()) {
            (!sizes.isFinite()).cast<double>().maxCoeff(&row, &column);
            return PlanePoint{x(row), t(column)};
        }
        const double greatest = sizes.maxCoeff(&row, &column);
        const bool grows = growth.add(
            std::max(size_off_pole(sizes.col(column), row), size_off_pole(sizes.row(row), column)));
        if (!grows && greatest <= level * sizes.minCoeff())
            return std::nullopt;
        in_x = in_x.next_to(x(row), in_x.spacing());
        in_t = in_t.next_to(t(column), in_t.spacing());
    }
    return growth.is_bounded() ? std::nullopt
                               : std::optional(PlanePoint{std::midpoint(in_x.begin, in_x.end),
                                                          std::midpoint(in_t.begin, in_t.end)});
}

/// The first time at which values are not all finite, as they are at `begin` and not at `end`.
double end_of_finite(const std::function<ArrayXd(double t)>& values, double begin, double end) {
    for (double middle = std::midpoint(begin, end); begin < middle && middle < end;
         middle = std::midpoint(begin, end))
        (values(middle).isFinite().all() ? begin : end) = middle;
    return end;
}

/// What unbounded_between finds next to a local maximum of |g| on a grid.
std::optional<double> unbounded_on(const ArrayXd& grid, const ArrayXd& values,
                                   const std::function<ArrayXd(const ArrayXd&)>& g) {
    const ArrayXd sizes = values.abs();
    for (Index k = 0; k < grid.size(); ++k) {
        const Index before = std::max<Index>(k - 1, 0);
        const Index behind = std::min(k + 1, grid.size() - 1);
        const bool rises = k == 0 || sizes(before) < sizes(k);
        if (!rises || sizes(behind) > sizes(k))
            continue;
        if (const auto a =
                unbounded_between(g, grid(before), grid(behind), size_off_pole(sizes, k)))
            return a;
    }
    return std::nullopt;
}

} // namespace

double largest_on_grid(const SpaceTimeFunction& g, const ArrayXd& times, double final_time,
                       const Place& place, const std::string& what, const std::string& exists) {
    const auto refuse = [&](double x, double t, double value, bool ends_there = true) {
        const std::string how =
            std::isfinite(value) ? " grows without bound towards" : " is not finite at";
        throw InputError(place,
                         what + how + " x = " + number_text(x) + ", t = " + number_text(t) +
                             " (it is " + number_text(value) + "); write it so that " + exists +
                             " everywhere on [0, 1] x [0, " + number_text(final_time) + "]" +
                             (ends_there && t > 0.0 ? ", or end the run before that time" : ""));
    };
    const ArrayXd x = sample_points(0.0, 1.0);
    ArrayXXd values(x.size(), times.size());
    for (Index j = 0; j < times.size(); ++j) {
        values.col(j) = g(x, times(j));
        if (values.col(j).isFinite().all())
            continue;
        const double end =
            j == 0 ? times(0)
                   : end_of_finite([&](double t) { return g(x, t); }, times(j - 1), times(j));
        const ArrayXd there = g(x, end);
        for (Index k = 0; k < x.size(); ++k)
            if (!std::isfinite(there(k)))
                refuse(x(k), end, there(k));
    }
    Index row = 0;
    Index column = 0;
    const double largest = values.abs().maxCoeff(&row, &column);
    const auto at = [&](double here, double t) { return g(ArrayXd::Constant(1, here), t)(0); };
    const auto in_x = [&](const ArrayXd& s) -> ArrayXd { return g(s, times(column)); };
    if (const auto a = unbounded_on(x, values.col(column), in_x))
        refuse(*a, times(column), at(*a, times(column)), false);
    const auto in_t = [&](const ArrayXd& s) -> ArrayXd {
        return s.unaryExpr([&](double t) { return at(x(row), t); });
    };
    if (const auto a = unbounded_on(times, values.row(row), in_t))
        refuse(x(row), *a, at(x(row), *a));
    const auto around = [](const ArrayXd& grid, Index k) {
        return CloseLook{grid(std::max<Index>(k - 1, 0)), grid(std::min(k + 1, grid.size() - 1))};
    };
    if (const auto a = unbounded_beside(g, around(x, row), around(times, column), largest))
        refuse(a->x, a->t, at(a->x, a->t));
    return largest;
}

void require_value(const ArrayXd& differences, const ArrayXd& times, double value, double tolerance,
                   const Place& place, const std::string& what, const std::string& rule) {
    Index greatest = 0;
    // One that is not a number is greater than all.
    const double size = differences.isNaN()
                            .select(std::numeric_limits<double>::infinity(), differences.abs())
                            .maxCoeff(&greatest);
    if (!(size <= tolerance))
        throw InputError(place,
                         what + " is " + number_text_beside(value + differences(greatest), value) +
                             " at t = " + number_text(times(greatest)) + "; it must be " + rule);
}

std::string jump_text(const std::string& what, double jump, double t, double x) {
    return what + " jumps by " + number_text(jump) + " at t = " + number_text(t) +
           ", x = " + number_text(x) + "; it must be continuous: ";
}

} // namespace tvbeam
