#pragma once

#include "core/problem.hpp"
#include "core/space/cells.hpp"
#include "core/space/mesh.hpp"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace tvbeam {

/// How finely [0, 1] must be cut for the rule of six points (element_rule) to integrate the
/// functions of a problem, found once for all meshes.
///
/// On an interval of length w the rule is compared with the same on its two halves, for
///
///     ∫ φ η^k dx, k = 0 … 3, η in [0, 1] the place in it,     ∫ φ² dx
///
/// which stand for loads of all basis functions, for products with discrete functions, and for the
/// norms. With ‖φ‖ of [0, 1], the greatest over time where φ depends on time, an interval is cut in
/// two until no difference is more than `tolerance` ‖φ‖ and `tolerance` ‖φ‖², plus what the
/// round-off of x makes: 4ε (w max|φ| + x (max φ − min φ)). The finer of the two then errs by far
/// less: of a smooth φ by 2^−12 of the difference. Nor is one left that is more than twice as long
/// as its neighbour.
///
/// A profile is also looked at in 8192 places, a function of space and time in 2048 at one time and
/// in 128 at every other, what is known to be gentle in 32: an interval is cut as well where φ
/// differs there by more than 1e-5 max|φ| from the polynomial through the six points. A spike of
/// width d, exp(−((x − c)/d)²), that is as high as the rest shows in 6.8 d, and hence is found
/// where d is above 4e-5, in time above 1.5e-4 if it is there at that time. What is narrower, lower
/// than 1e-5 of the rest, or there for a short time only can be missed. A profile is looked at
/// again in the intervals that others were cut to.
class Resolution {
public:
    /// A function with its sizes.
    struct Sampled {
        SpaceFunction function;
        double norm = 0.0;     ///< ‖φ‖, or the greatest of the field's in time
        double greatest = 0.0; ///< max|φ|, likewise
    };

    /// Differences between the rule and its halves that pass, over ‖φ‖: of a profile, which is
    /// integrated once; of a function of space and time, which is integrated in every step.
    static constexpr double profile_tolerance = 1e-14;
    static constexpr double step_tolerance = 1e-12;

    /// Intervals after which no more are cut, of profiles and of functions of space and time.
    static constexpr std::size_t most_intervals = 32768;
    static constexpr std::size_t most_step_intervals = 4096;

    /// Of functions that every mesh integrates: one interval.
    Resolution() = default;

    /// Intervals that somebody knows to be fine enough: all of [0, 1], in order.
    explicit Resolution(std::vector<Interval> intervals) : intervals_(std::move(intervals)) {}

    /// The mesh with the cells that it needs: its elements, cut in two until none is longer than an
    /// interval that it meets. None where no element is.
    [[nodiscard]] Mesh on(Mesh mesh) const;

    /// Whether the intervals resolve all that was looked at.
    [[nodiscard]] bool is_certain() const { return unresolved_.empty(); }

    /// What is uncertain about the integrals of a function on the cells of a mesh: of its loads
    /// over its norm, or of its square over that of the norm, by the intervals that it needs
    /// itself, and by what the rule and its halves still differ by on those. The greatest of all
    /// functions that are not resolved; zero where all are.
    [[nodiscard]] double uncertainty(const Mesh& mesh) const;

    [[nodiscard]] const std::vector<Interval>& intervals() const { return intervals_; }

private:
    friend class Resolver;

    std::vector<Interval> intervals_{{0.0, 1.0}};

    /// A function that the intervals do not resolve, with its own.
    struct Unresolved {
        Sampled sampled;
        std::vector<Interval> intervals;
    };
    std::vector<Unresolved> unresolved_;
};

/// The resolution of the profiles of these fields, and of what does not separate in them at times
/// in every phase, as many as it takes until fresh ones show nothing new: at most 133.
/// curvature_initial is looked at t = 0 alone.
Resolution resolve(const ProblemData& data, const std::vector<const Field*>& fields,
                   double final_time);

} // namespace tvbeam
