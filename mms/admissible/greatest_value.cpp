#include "mms/admissible/greatest_value.hpp"

#include "mms/admissible/sampled_rules.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace tvbeam {

namespace {

/// A time and the enclosure of the function there.
struct Point {
    double t;
    Range value;
};

struct Part {
    Point begin, end;
    double bound;

    bool operator<(const Part& other) const { return bound < other.bound; }
};

} // namespace

GreatestValue greatest_value(const EnclosedFunction& function, double begin, double end,
                             double limit, double tolerance, std::int64_t most_parts) {
    GreatestValue result{limit, begin, true};
    const auto at = [&](double t) {
        const Point point{t, function(t, t).value};
        if (point.value.lower > result.value) {
            result.value = point.value.lower;
            result.t = t;
        }
        return point;
    };
    const auto reached = [&] {
        return result.value > limit
                   ? result.value + std::max(tolerance, relative_tolerance * std::abs(result.value))
                   : limit;
    };
    std::priority_queue<Part> parts;
    const auto add = [&](const Point& from, const Point& to) {
        const auto [value, slope] = function(from.t, to.t);
        const double length = to.t - from.t;
        // The mean value theorem wants a function that is smooth between: none with a pole there,
        // whose value or slope has no bound.
        const bool is_smooth = std::isfinite(value.lower) && std::isfinite(value.upper) &&
                               std::isfinite(slope.lower) && std::isfinite(slope.upper);
        const double bound =
            is_smooth
                ? std::min({value.upper, from.value.upper + std::max(slope.upper, 0.0) * length,
                            to.value.upper + std::max(-slope.lower, 0.0) * length})
                : value.upper;
        if (bound > reached())
            parts.push({from, to, bound});
    };
    add(at(begin), at(end));
    for (std::int64_t count = 0; !parts.empty() && parts.top().bound > reached(); ++count) {
        const Part part = parts.top();
        parts.pop();
        const double middle = part.begin.t + 0.5 * (part.end.t - part.begin.t);
        if (count >= most_parts)
            return {result.value, result.t, false};
        if (!(part.begin.t < middle && middle < part.end.t)) {
            result.proven = false;
            continue;
        }
        const Point halfway = at(middle);
        add(part.begin, halfway);
        add(halfway, part.end);
    }
    return result;
}

} // namespace tvbeam
