#include "mms/largest_size.hpp"

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

/// Points in space and time.
struct Points {
    std::vector<double> x, t;

    void add(double at_x, double at_t) {
        x.push_back(at_x);
        t.push_back(at_t);
    }
};

ArrayXd points_of(const CloseLook& span) {
    return span.begin < span.end ? sample_points(span.begin, span.end)
                                 : ArrayXd::Constant(1, span.begin);
}

/// Those of points_of, and towards both ends ever closer ones.
std::vector<double> times_of(const CloseLook& span) {
    const ArrayXd even = points_of(span);
    std::vector<double> times(even.begin(), even.end());
    constexpr int closer = 6;
    double distance = (span.end - span.begin) / static_cast<double>(grid_points - 1);
    for (int k = 0; k < closer && distance > 0.0; ++k) {
        distance *= 0.25;
        times.push_back(span.begin + distance);
        times.push_back(span.end - distance);
    }
    return times;
}

Points scattered(const CloseLook& x, const CloseLook& t) {
    Points points;
    for (const double at_t : times_of(t))
        for (const double at_x : points_of(x))
            points.add(at_x, at_t);
    // The fractional parts of the multiples of the golden ratio stay apart from one another; times
    // at so much of the way between two are no zeros of a sine.
    constexpr int count = 2048;
    constexpr double golden_ratio = 0.6180339887498949;
    for (int k = 0; k < count; ++k) {
        const double place = k + golden_ratio;
        const double multiple = place * golden_ratio;
        points.add(x.begin + (multiple - std::floor(multiple)) * (x.end - x.begin),
                   t.begin + place / count * (t.end - t.begin));
    }
    return points;
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
    [[nodiscard]] ArrayXd sizes(const ArrayXd& x, const ArrayXd& t) const {
        const ArrayXd values = g_(x, t);
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
        const Points points = scattered(x_, t_);
        const auto count = static_cast<Index>(points.x.size());
        const ArrayXd found = sizes(Eigen::Map<const ArrayXd>(points.x.data(), count),
                                    Eigen::Map<const ArrayXd>(points.t.data(), count));
        std::vector<Sample> largest(parts_x * parts_t);
        for (std::size_t k = 0; k < points.x.size(); ++k) {
            Sample& known =
                largest[parts_t * part(x_, parts_x, points.x[k]) + part(t_, parts_t, points.t[k])];
            if (const double size = found(static_cast<Index>(k)); size > known.size)
                known = {points.x[k], points.t[k], size, spacing(x_), spacing(t_)};
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
        const ArrayXd found =
            sizes(x.replicate(t.size(), 1), t.transpose().replicate(x.size(), 1).reshaped());
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
