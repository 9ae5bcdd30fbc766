#include "mms/largest_size.hpp"

#include "core/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::Index;

namespace {

struct Sample {
    double x = 0.0, t = 0.0, size = 0.0;
    double distance_x = 0.0, distance_t = 0.0; ///< up to which a larger one is looked for
};

ArrayXd points_of(const CloseLook& span) {
    return span.begin < span.end ? sample_points(span.begin, span.end)
                                 : ArrayXd::Constant(1, span.begin);
}

/// Those of points_of, and towards both ends ever closer ones.
ArrayXd times_of(const CloseLook& span) {
    const ArrayXd even = points_of(span);
    std::vector<double> times(even.begin(), even.end());
    constexpr int closer = 6;
    double distance = (span.end - span.begin) / static_cast<double>(grid_points - 1);
    for (int k = 0; k < closer && distance > 0.0; ++k) {
        distance *= 0.25;
        times.push_back(span.begin + distance);
        times.push_back(span.end - distance);
    }
    return Eigen::Map<const ArrayXd>(times.data(), static_cast<Index>(times.size()));
}

/// Points of which no two have the same x or t: the fractional parts of the multiples of the golden
/// ratio stay apart from one another, and times at so much of the way between two are no zeros of a
/// sine.
Points scattered(const CloseLook& x, const CloseLook& t) {
    constexpr Index count = 2048;
    constexpr double golden_ratio = 0.6180339887498949;
    const ArrayXd places =
        ArrayXd::LinSpaced(count, 0.0, static_cast<double>(count - 1)) + golden_ratio;
    const ArrayXd multiples = places * golden_ratio;
    return {x.begin + (multiples - multiples.floor()) * (x.end - x.begin),
            t.begin + places / static_cast<double>(count) * (t.end - t.begin)};
}

class LargestSize {
public:
    LargestSize(const PointFunction& g, const CloseLook& x, const CloseLook& t)
        : g_(g), x_(x), t_(t) {}

    [[nodiscard]] LargestPoint point() const {
        constexpr std::size_t looked_at = 8;
        constexpr int fewest_looks = 4; // the last of them between the times of any two points
        constexpr int most_looks = 20;
        constexpr double least_growth = 1e-6;
        std::vector<Sample> samples = largest_of_parts();
        std::ranges::sort(samples, std::greater{}, &Sample::size);
        samples.resize(std::min(samples.size(), looked_at));
        LargestPoint largest;
        bool grows = true;
        for (int look = 0; look < fewest_looks || (grows && look < most_looks); ++look) {
            const double before = largest.size;
            for (Sample& sample : samples) {
                look_closer(sample);
                if (sample.size > largest.size)
                    largest = {sample.x, sample.t, sample.size};
            }
            grows = largest.size > (1.0 + least_growth) * before;
        }
        return largest;
    }

private:
    [[nodiscard]] ArrayXd sizes(const Points& points) const {
        const ArrayXd values = g_(points.x, points.t);
        return values.isFinite().select(values.abs(), 0.0);
    }

    /// In each of several parts of the region the point that has the largest |g|, if it is not
    /// zero.
    [[nodiscard]] std::vector<Sample> largest_of_parts() const {
        constexpr std::size_t parts_x = 16; // none has two peaks of what the grid resolves
        constexpr std::size_t parts_t = 8;
        const auto part = [](const CloseLook& span, std::size_t parts, double at) {
            const double length = span.end - span.begin;
            return length > 0.0
                       ? std::min(parts - 1, static_cast<std::size_t>(static_cast<double>(parts) *
                                                                      (at - span.begin) / length))
                       : std::size_t{0};
        };
        std::vector<Sample> largest(parts_x * parts_t);
        for (const Points& points : {point_grid(points_of(x_), times_of(t_)), scattered(x_, t_)}) {
            const ArrayXd found = sizes(points);
            for (Index k = 0; k < found.size(); ++k) {
                Sample& known = largest[parts_t * part(x_, parts_x, points.x(k)) +
                                        part(t_, parts_t, points.t(k))];
                if (found(k) > known.size)
                    known = {points.x(k), points.t(k), found(k), spacing(x_), spacing(t_)};
            }
        }
        std::erase_if(largest, [](const Sample& sample) { return sample.size == 0.0; });
        return largest;
    }

    static double spacing(const CloseLook& span) {
        return (span.end - span.begin) / static_cast<double>(grid_points - 1);
    }

    /// Whether the largest of these samples is their first or last, and the span goes on there.
    static bool is_at_edge(const CloseLook& span, const ArrayXd& samples, Index k) {
        return (k == 0 && samples(k) > span.begin) ||
               (k == samples.size() - 1 && samples(k) < span.end);
    }

    /// Moves to the largest |g| no further away than its distances, and halves these twice where
    /// that is within them: beyond their edge there may be larger ones.
    void look_closer(Sample& best) const {
        const ArrayXd x = x_.next_to(best.x, best.distance_x).samples();
        const ArrayXd t = t_.next_to(best.t, best.distance_t).samples();
        const ArrayXd found = sizes(point_grid(x, t));
        Index at = 0;
        const double size = found.maxCoeff(&at);
        const bool moves = size > best.size;
        const Index in_x = at % x.size();
        const Index in_t = at / x.size();
        if (!moves || !is_at_edge(x_, x, in_x))
            best.distance_x *= 0.25;
        if (!moves || !is_at_edge(t_, t, in_t))
            best.distance_t *= 0.25;
        if (moves) {
            best.x = x(in_x);
            best.t = t(in_t);
            best.size = size;
        }
    }

    const PointFunction& g_;
    CloseLook x_, t_;
};

} // namespace

LargestPoint largest_point(const PointFunction& g, const CloseLook& x, const CloseLook& t) {
    return LargestSize(g, x, t).point();
}

double largest_size(const PointFunction& g, const CloseLook& x, const CloseLook& t) {
    return largest_point(g, x, t).size;
}

} // namespace tvbeam
