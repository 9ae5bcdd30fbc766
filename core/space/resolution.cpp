#include "core/space/resolution.hpp"

#include "core/space/linear_elements.hpp"
#include "core/space/quadrature.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>
#include <utility>

namespace tvbeam {

using Eigen::Array;
using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();
constexpr double shortest = 0x1p-48;
constexpr double seen = 1e-5;          // of max|φ|: what a look at a place notices
constexpr double beside_end = 0x1p-10; // of an interval; the rule's first point is at 0.034
constexpr double jump =
    1e-3; // of max|φ|, from an end to beside_end: a root has less on what is left

using AtRule = Array<double, element_rule_size, Eigen::Dynamic>;
using Moments = Eigen::Matrix<double, 4, element_rule_size>;
using Square = Eigen::Matrix<double, element_rule_size, element_rule_size>;

/// φ at the points of the rule on intervals, a column each.
AtRule at_rule(const SpaceFunction& function, const std::vector<Interval>& intervals) {
    const ArrayXd& rule = element_rule().points;
    AtRule x(element_rule_size, static_cast<Index>(intervals.size()));
    for (std::size_t i = 0; i < intervals.size(); ++i)
        x.col(static_cast<Index>(i)) = intervals[i].left + intervals[i].length * rule;
    const ArrayXd values = function(x.reshaped());
    return values.reshaped(x.rows(), x.cols());
}

std::vector<Interval> halves_of(const std::vector<Interval>& intervals) {
    std::vector<Interval> halves;
    halves.reserve(2 * intervals.size());
    for (const auto& [left, length] : intervals) {
        halves.push_back({left, length / 2.0});
        halves.push_back({left + length / 2.0, length / 2.0});
    }
    return halves;
}

/// The weights of ∫_0^1 φ η^k dη, k = 0 … 3, by the rule on the part [left, left + length].
Moments moment_weights(double left, double length) {
    const GaussRule& rule = element_rule();
    Moments weights;
    for (int k = 0; k < weights.rows(); ++k)
        weights.row(k) =
            (length * rule.weights * (left + length * rule.points).pow(k)).matrix().transpose();
    return weights;
}

/// What the rule and its halves differ by on each interval beyond round-off: the greater of the
/// moments' over ‖φ‖ and the square's over ‖φ‖². Where φ is not finite zero: the run says so.
ArrayXd differences(const std::vector<Interval>& intervals, const AtRule& whole,
                    const AtRule& halves, double norm) {
    static const Moments one = moment_weights(0.0, 1.0);
    static const Moments left = moment_weights(0.0, 0.5);
    static const Moments right = moment_weights(0.5, 0.5);
    ArrayXd result(whole.cols());
    for (Index i = 0; i < whole.cols(); ++i) {
        const auto& [start, length] = intervals[static_cast<std::size_t>(i)];
        const auto v = whole.col(i);
        const auto v_left = halves.col(2 * i);
        const auto v_right = halves.col(2 * i + 1);
        const double of_moments =
            (one * v.matrix() - left * v_left.matrix() - right * v_right.matrix())
                .cwiseAbs()
                .maxCoeff();
        const double of_square = std::abs(one.row(0).dot(v.square().matrix()) -
                                          left.row(0).dot(v_left.square().matrix()) -
                                          right.row(0).dot(v_right.square().matrix()));
        const double highest = std::max({v.maxCoeff(), v_left.maxCoeff(), v_right.maxCoeff()});
        const double lowest = std::min({v.minCoeff(), v_left.minCoeff(), v_right.minCoeff()});
        const double greatest = std::max(std::abs(highest), std::abs(lowest));
        const double round_off =
            4.0 * machine_epsilon * (length * greatest + (start + length) * (highest - lowest));
        const double excess =
            std::max((length * of_moments - round_off) / norm,
                     (length * of_square - 2.0 * greatest * round_off) / (norm * norm));
        result(i) = std::isfinite(excess) ? std::max(excess, 0.0) : 0.0;
    }
    return result;
}

/// count places all over (0, 1), in order: neighbours are at most 1.2/count apart, other ones for
/// every offset, and none with a period.
ArrayXd spread_places(Index count, double offset) {
    const auto turned = [](double turns) { return turns - std::floor(turns); };
    const ArrayXd i = ArrayXd::LinSpaced(count, 0.0, static_cast<double>(count - 1));
    const ArrayXd turns = (i + 0.5) / std::numbers::phi;
    return (i + 0.8 * turned(offset / std::numbers::phi) + 0.2 * (turns - turns.floor())) /
           static_cast<double>(count);
}

/// The coefficients of ξ^k in the polynomials through values at the points of the rule, a column
/// each.
AtRule coefficients(const AtRule& values) {
    static const Square inverse = [] {
        Square powers;
        for (int k = 0; k < element_rule_size; ++k)
            powers.col(k) = element_rule().points.pow(k).matrix();
        return Square(powers.inverse());
    }();
    return (inverse * values.matrix()).array();
}

/// The polynomial of such coefficients at places ξ, or at one.
template <typename Coefficients, typename Places>
Places value_of(const Coefficients& c, const Places& xi) {
    Places value = c(element_rule_size - 1) + 0.0 * xi;
    for (Index k = element_rule_size - 1; k-- > 0;)
        value = value * xi + c(k);
    return value;
}

double finest_of(const std::vector<Interval>& intervals) {
    double finest = 1.0;
    for (const auto& interval : intervals)
        finest = std::min(finest, interval.length);
    return finest;
}

std::vector<Interval> as_intervals(const Mesh& mesh) {
    std::vector<Interval> intervals;
    for (Index j = 0; j < mesh.elements(); ++j)
        intervals.push_back({mesh.nodes(j), mesh.lengths(j)});
    return intervals;
}

} // namespace

/// Cuts the intervals of a resolution for one function after the other.
class Resolver {
public:
    /// A function with what is known of it: its values at some places.
    struct Look {
        Resolution::Sampled sampled;
        ArrayXd x;
        ArrayXd values;
    };

    /// A look at a function in so many places; offset: others than before.
    static Look look(SpaceFunction function, Index count, double offset) {
        Look look;
        look.x = spread_places(count, offset);
        look.values = function(look.x);
        look.sampled = {std::move(function), std::sqrt(look.values.square().mean()),
                        look.values.abs().maxCoeff()};
        return look;
    }

    /// Whether all intervals passed as they were. A function that is not resolved with so many
    /// intervals stays behind as unresolved.
    bool cut_for(Look look, double tolerance, std::size_t most) {
        if (!(look.sampled.norm > 0.0) || !std::isfinite(look.sampled.norm))
            return true;
        const std::size_t before = result_.intervals_.size();
        bool resolved = refine(look.sampled, tolerance, most);
        while (resolved && (cut_beside_short_ones(most) || cut_where_it_differs(look, most)))
            resolved = refine(look.sampled, tolerance, most);
        if (!resolved)
            result_.unresolved_.push_back({look.sampled, result_.intervals_});
        return resolved && result_.intervals_.size() == before;
    }

    /// Looks at a function where the intervals are, which were cut for others as well: whether it
    /// is larger there than was known. A source is next to zero but where its solution has a layer.
    bool sees_more_of(Look& look) const {
        return grow(look.sampled, result_.intervals_,
                    at_rule(look.sampled.function, result_.intervals_));
    }

    /// Cuts nothing; a function for which it would is unresolved.
    void test(const Look& look, double tolerance, std::size_t most) {
        Resolver other = *this;
        if (!other.cut_for(look, tolerance, most))
            result_.unresolved_.push_back({look.sampled, std::move(other.result_.intervals_)});
    }

    [[nodiscard]] double finest() const { return finest_of(result_.intervals_); }

    [[nodiscard]] Resolution result() && { return std::move(result_); }

private:
    /// Takes the sizes of a function from its values at the rule on some intervals, where they are
    /// far greater than what was known. Whether they are.
    static bool grow(Resolution::Sampled& f, const std::vector<Interval>& intervals,
                     const AtRule& values) {
        constexpr double far = 2.0;
        double square = 0.0;
        for (std::size_t i = 0; i < intervals.size(); ++i)
            square += intervals[i].length *
                      (element_rule().weights * values.col(static_cast<Index>(i)).square()).sum();
        const double norm = std::sqrt(square);
        if (!(norm > far * f.norm && std::isfinite(norm)))
            return false;
        f.norm = norm;
        f.greatest = std::max(f.greatest, values.abs().maxCoeff());
        return true;
    }

    /// Cuts in two what the rule does not integrate. False: there would be too many intervals. What
    /// a look saw the foot of alone grows as it is met.
    bool refine(Resolution::Sampled& f, double tolerance, std::size_t most) {
        std::vector<Interval> done;
        std::vector<Interval> open = std::move(result_.intervals_);
        AtRule whole = at_rule(f.function, open);
        bool resolved = true;
        while (!open.empty()) {
            const std::vector<Interval> halves = halves_of(open);
            const AtRule at_halves = at_rule(f.function, halves);
            grow(f, halves, at_halves);
            const ArrayXd excess = differences(open, whole, at_halves, f.norm);
            std::vector<Interval> next;
            std::vector<Index> columns;
            for (std::size_t i = 0; i < open.size(); ++i) {
                const bool passes =
                    excess(static_cast<Index>(i)) <= tolerance || open[i].length <= shortest;
                const bool full = done.size() + next.size() + (open.size() - i) >= most;
                resolved = resolved && (passes || !full);
                if (passes || full) {
                    done.push_back(open[i]);
                    continue;
                }
                for (const std::size_t half : {2 * i, 2 * i + 1}) {
                    next.push_back(halves[half]);
                    columns.push_back(static_cast<Index>(half));
                }
            }
            whole = AtRule(at_halves(Eigen::all, columns));
            open = std::move(next);
        }
        std::sort(done.begin(), done.end(),
                  [](const Interval& a, const Interval& b) { return a.left < b.left; });
        result_.intervals_ = std::move(done);
        return resolved;
    }

    /// Cuts in two what is more than twice as long as its neighbour, which a foot of something
    /// narrow may reach across their common end. Whether there was any.
    bool cut_beside_short_ones(std::size_t most) {
        const std::vector<Interval>& intervals = result_.intervals_;
        std::vector<Interval> next;
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            const double shorter =
                std::min(i > 0 ? intervals[i - 1].length : 1.0,
                         i + 1 < intervals.size() ? intervals[i + 1].length : 1.0);
            if (intervals[i].length <= 2.0 * shorter)
                next.push_back(intervals[i]);
            else
                for (const Interval& half : halves_of({intervals[i]}))
                    next.push_back(half);
        }
        return replaced_by(std::move(next), most);
    }

    /// Cuts in two where a look shows what the six points do not, or a place beside each end: a
    /// jump there is outside all points of the rule, and of its halves. Whether there was any.
    bool cut_where_it_differs(const Look& look, std::size_t most) {
        const AtRule polynomials = coefficients(at_rule(look.sampled.function, result_.intervals_));
        const Eigen::Array2Xd beside_ends = values_beside_ends(look.sampled.function);
        const double bound = seen * look.sampled.greatest;
        std::vector<Interval> intervals;
        Index first = 0;
        for (std::size_t i = 0; i < result_.intervals_.size(); ++i) {
            const Interval& interval = result_.intervals_[i];
            Index end = first;
            while (end < look.x.size() && look.x(end) < interval.left + interval.length)
                ++end;
            const ArrayXd xi =
                (look.x.segment(first, end - first) - interval.left) / interval.length;
            const auto at = static_cast<Index>(i);
            const auto c = polynomials.col(at);
            const ArrayXd p = value_of(c, xi);
            const double at_start = value_of(c, beside_end) - beside_ends(0, at);
            const double at_end = value_of(c, 1.0 - beside_end) - beside_ends(1, at);
            const bool differs =
                std::max(std::abs(at_start), std::abs(at_end)) > jump * look.sampled.greatest ||
                ((p - look.values.segment(first, end - first)).abs() > bound).any();
            first = end;
            if (!differs || interval.length <= shortest) {
                intervals.push_back(interval);
                continue;
            }
            for (const Interval& half : halves_of({interval}))
                intervals.push_back(half);
        }
        return replaced_by(std::move(intervals), most);
    }

    /// φ beside the left and the right end of each interval.
    [[nodiscard]] Eigen::Array2Xd values_beside_ends(const SpaceFunction& function) const {
        Eigen::Array2Xd x(2, static_cast<Index>(result_.intervals_.size()));
        for (Index i = 0; i < x.cols(); ++i) {
            const auto& [left, length] = result_.intervals_[static_cast<std::size_t>(i)];
            x.col(i) << left + beside_end * length, left + (1.0 - beside_end) * length;
        }
        const ArrayXd values = function(x.reshaped());
        return values.reshaped(x.rows(), x.cols());
    }

    /// Takes the intervals if they are more than before, and not too many.
    bool replaced_by(std::vector<Interval> intervals, std::size_t most) {
        const bool more = intervals.size() > result_.intervals_.size() && intervals.size() <= most;
        if (more)
            result_.intervals_ = std::move(intervals);
        return more;
    }

    Resolution result_;
};

Mesh Resolution::on(Mesh mesh) const {
    mesh.cells = nullptr;
    const double finest = finest_of(intervals_);
    constexpr double slack = 1.0 + 1e-9;
    if (mesh.lengths.maxCoeff() <= slack * finest)
        return mesh;
    std::vector<std::vector<Interval>> parts(static_cast<std::size_t>(mesh.elements()));
    bool whole = true;
    for (Index j = 0; j < mesh.elements(); ++j) {
        auto& element = parts[static_cast<std::size_t>(j)];
        std::vector<Interval> open{{0.0, 1.0}};
        while (!open.empty()) {
            const Interval part = open.back();
            open.pop_back();
            const double length = mesh.lengths(j) * part.length;
            const double left = mesh.nodes(j) + mesh.lengths(j) * part.left;
            const double margin = 1e-9 * length; // of a neighbour that is only touched
            auto met = std::upper_bound(
                intervals_.begin(), intervals_.end(), left + margin,
                [](double x, const Interval& interval) { return x < interval.left; });
            --met;
            bool fits = true;
            for (; fits && met != intervals_.end() && met->left < left + length - margin; ++met)
                fits = length <= slack * met->length;
            if (fits) {
                element.push_back(part);
                continue;
            }
            whole = false;
            open.push_back({part.left + part.length / 2.0, part.length / 2.0});
            open.push_back({part.left, part.length / 2.0});
        }
    }
    return whole ? mesh : with_cells(std::move(mesh), parts);
}

double Resolution::uncertainty(const Mesh& mesh) const {
    const Mesh& cells = integration_mesh(mesh);
    double greatest = 0.0;
    for (const auto& [sampled, intervals] : unresolved_) {
        const SpaceFunction& f = sampled.function;
        const SpaceFunction square = [&](const ArrayXd& x) -> ArrayXd { return f(x).square(); };
        const Mesh fine = Resolution(intervals).on(cells);
        const double of_loads =
            (hat_loads(cells, f) - hat_loads(fine, f)).lpNorm<1>() / sampled.norm;
        const double of_square = (hat_loads(cells, square) - hat_loads(fine, square)).lpNorm<1>() /
                                 (sampled.norm * sampled.norm);
        const std::vector<Interval> finest = as_intervals(integration_mesh(fine));
        const double left =
            differences(finest, at_rule(f, finest), at_rule(f, halves_of(finest)), sampled.norm)
                .sum();
        greatest = std::max(greatest, std::max(of_loads, of_square) + left);
    }
    return greatest;
}

namespace {

constexpr Index profile_places = 8192;
constexpr Index gentle_places = 32; // of what is known to hold nothing narrow
constexpr Index step_places = 128;  // at every time
constexpr Index once_places = 2048; // at one time
constexpr double cancellation_noise =
    64.0 * machine_epsilon;            // of the greatest field: what terms leave that cancel
constexpr double narrow = 1.0 / 256.0; // an interval in which more places are worth while
constexpr std::size_t first_times = 5; // of every phase
constexpr std::size_t more_times = 4;  // that must show nothing new; twice as many after they do
// The last of these are not cut for: they tell what is left.
constexpr std::size_t most_times = 129;

/// Fresh times again and again: the ends of the phases first, then others all over them.
class SampleTimes {
public:
    SampleTimes(const std::vector<double>& phase_ends, double final_time) {
        for (const double end : phase_ends)
            if (end > 0.0 && end < final_time)
                ends_.push_back(end);
        ends_.push_back(final_time);
    }

    /// So many of every phase.
    std::vector<double> next(std::size_t count) {
        std::vector<double> times;
        double begin = 0.0;
        for (const double end : ends_) {
            for (std::size_t i = drawn_; i < drawn_ + count; ++i) {
                const double at = static_cast<double>(i) / std::numbers::phi;
                times.push_back(i == 0 ? end : begin + (end - begin) * (at - std::floor(at)));
            }
            begin = end;
        }
        if (drawn_ == 0)
            times.push_back(0.0);
        drawn_ += count;
        return times;
    }

    [[nodiscard]] std::size_t drawn() const { return drawn_; }

private:
    std::vector<double> ends_;
    std::size_t drawn_ = 0;
};

/// Looks at what does not separate in a field at some times, with its sizes the greatest in time so
/// far.
class FieldInTime {
public:
    FieldInTime(const Field& field, bool at_start)
        : rest_(std::make_shared<SpaceTimeFunction>(field.rest)), gentle_(field.gentle),
          at_start_(at_start) {}

    /// is_narrow: something narrow was found, which may be elsewhere at these times.
    std::vector<Resolver::Look> at(const std::vector<double>& times, bool is_narrow) {
        std::vector<Resolver::Look> looks;
        for (const double t : at_start_ ? std::vector<double>{0.0} : times) {
            const Index count = gentle_        ? gentle_places
                                : is_narrow    ? profile_places
                                : looked_ == 1 ? once_places
                                               : step_places;
            looks.push_back(
                Resolver::look([rest = rest_, t](const ArrayXd& x) { return (*rest)(x, t); }, count,
                               static_cast<double>(looked_++)));
            const auto& sampled = looks.back().sampled;
            if (sampled.norm > norm_) // false for NaN
                norm_ = sampled.norm;
            if (sampled.greatest > greatest_)
                greatest_ = sampled.greatest;
        }
        for (auto& look : looks) {
            look.sampled.norm = norm_;
            look.sampled.greatest = greatest_;
        }
        return looks;
    }

private:
    std::shared_ptr<const SpaceTimeFunction> rest_;
    bool gentle_;
    bool at_start_;
    double norm_ = 0.0;
    double greatest_ = 0.0;
    Index looked_ = 0;
};

void resolve_profiles(const ProblemData& data, const std::vector<const Field*>& fields,
                      Resolver& resolver) {
    std::set<Index> profiles;
    for (const Field* field : fields)
        for (const auto& term : field->terms)
            profiles.insert(term.profile);
    std::vector<Resolver::Look> looks;
    const auto cut_for = [&](const Resolver::Look& look) {
        resolver.cut_for(look, Resolution::profile_tolerance, Resolution::most_intervals);
    };
    for (const Index r : profiles) {
        const auto index = static_cast<std::size_t>(r);
        const bool gentle = index < data.gentle_profiles.size() && data.gentle_profiles[index];
        looks.push_back(
            Resolver::look(data.profiles[index], gentle ? gentle_places : profile_places, 0.0));
        cut_for(looks.back());
    }
    if (resolver.finest() < narrow)
        for (auto& look : looks)
            if (resolver.sees_more_of(look))
                cut_for(look);
}

} // namespace

Resolution resolve(const ProblemData& data, const std::vector<const Field*>& fields,
                   double final_time) {
    Resolver resolver;
    resolve_profiles(data, fields, resolver);
    std::vector<FieldInTime> in_time;
    for (const Field* field : fields)
        if (field->rest)
            in_time.emplace_back(*field, field == &data.curvature_initial);
    SampleTimes times(data.phase_ends, final_time);
    std::size_t count = first_times;
    double greatest = 0.0; // of all fields
    for (bool fresh = !in_time.empty(); fresh;) {
        const bool first = times.drawn() == 0;
        const bool last = times.drawn() + count >= most_times;
        const std::vector<double> sampled = times.next(count);
        fresh = first;
        std::vector<Resolver::Look> looks;
        for (auto& field : in_time)
            for (auto& look : field.at(sampled, !first && resolver.finest() < narrow))
                looks.push_back(std::move(look));
        for (const auto& look : looks)
            greatest = std::max(greatest, look.sampled.greatest);
        for (const auto& look : looks)
            if (look.sampled.greatest <= cancellation_noise * greatest)
                continue;
            else if (last)
                resolver.test(look, Resolution::step_tolerance, Resolution::most_step_intervals);
            else if (!resolver.cut_for(look, Resolution::step_tolerance,
                                       Resolution::most_step_intervals))
                fresh = true;
        count = first ? more_times : 2 * count;
        fresh = fresh && !last;
    }
    return std::move(resolver).result();
}

} // namespace tvbeam
