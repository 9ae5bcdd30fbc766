#include "mms/admissible/jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

constexpr double narrowest = 1e-8; // of the grid's length; nearer, a formula may be rounding errors
constexpr double beside = 1e-7;    // … where both sides of a jump are looked at
constexpr std::size_t most_intervals = 512;

/// Intervals of one length side by side, one a column of each array.
struct Intervals {
    ArrayXd begin, end;
    ArrayXXd before, after; ///< the functions at both ends
    ArrayXXd middle = {};

    [[nodiscard]] Index size() const { return begin.size(); }
    [[nodiscard]] ArrayXd centre() const { return begin + 0.5 * (end - begin); }
    [[nodiscard]] ArrayXXd distance() const { return (middle - 0.5 * (before + after)).abs(); }

    [[nodiscard]] Intervals only(const std::vector<Index>& kept) const {
        return {begin(kept), end(kept), before(Eigen::all, kept), after(Eigen::all, kept),
                middle(Eigen::all, kept)};
    }

    /// The first halves, and behind them the second ones.
    [[nodiscard]] Intervals halves(const FunctionRows& functions) const {
        Intervals both{ArrayXd(2 * size()), ArrayXd(2 * size()),
                       ArrayXXd(before.rows(), 2 * size()), ArrayXXd(before.rows(), 2 * size())};
        both.begin << begin, centre();
        both.end << centre(), end;
        both.before << before, middle;
        both.after << middle, after;
        both.middle = functions(both.centre());
        return both;
    }
};

/// The jump that an interval holds, if the functions hardly change on both sides of it: a layer,
/// and rounding errors, do.
std::optional<Jump> jump_in(const Intervals& intervals, Index k, const FunctionRows& functions,
                            double length, const ArrayXd& least) {
    constexpr double hardly = 0.1; // of the jump
    // Right at a jump a formula may be 0/0.
    const bool is_finite = intervals.middle.col(k).isFinite().all();
    const double at = is_finite ? intervals.end(k) : intervals.centre()(k);
    const ArrayXd steps = beside * length * ArrayXd{{1.0, 1.4, 2.1, 3.3, 5.2}};
    const ArrayXXd left = functions(at - steps);
    const ArrayXXd right = functions(at + steps);
    const auto spread = [](const auto& row) { return row.maxCoeff() - row.minCoeff(); };
    std::optional<Jump> largest;
    for (Index row = 0; row < left.rows(); ++row) {
        const double of_sides = right.row(row).mean() - left.row(row).mean();
        const double of_ends = intervals.after(row, k) - intervals.before(row, k);
        const double difference = std::abs(of_ends - of_sides);
        // Right at a jump the values of a formula may be rounding errors, or none.
        const bool is_there =
            !std::isfinite(intervals.middle(row, k)) || difference <= 0.5 * std::abs(of_sides);
        const double jump = difference <= hardly * std::abs(of_sides) ? of_ends : of_sides;
        const double change = std::max(spread(left.row(row)), spread(right.row(row)));
        if (is_there && std::abs(jump) > 2.0 * least(row) && change <= hardly * std::abs(jump) &&
            !(largest && std::abs(jump) <= std::abs(largest->size)))
            largest = Jump{row, at, jump};
    }
    return largest;
}

} // namespace

ArrayXd parts_to_search(bool is_expected) {
    ArrayXd few{{0.1234567, 0.4321, 0.8765}};
    if (!is_expected)
        return few;
    constexpr Index further = 30;
    ArrayXd parts(few.size() + further);
    parts << few, ArrayXd::LinSpaced(further, 0.0123, 0.98765);
    return parts;
}

ArrayXd uneven_grid(double begin, double end) {
    constexpr Index count = 65;
    ArrayXd points = ArrayXd::LinSpaced(count, begin, end);
    points.segment(1, count - 2) += 0.382 / static_cast<double>(count) * (end - begin);
    return points;
}

std::optional<Jump> find_jump(const FunctionRows& functions, const ArrayXd& grid,
                              double least_distance) {
    const Index count = grid.size() - 1;
    const double length = grid(count) - grid(0);
    const ArrayXXd on_grid = functions(grid);
    const ArrayXd least = least_distance * on_grid.abs().rowwise().maxCoeff();
    // The curvature beside a small jump may take off most of its distance from linear; where none
    // is expected, to look closer takes time alone.
    const double halved_from = least_distance < least_jump(false) ? 0.25 : 1.0;
    Intervals here{grid.head(count), grid.tail(count), on_grid.leftCols(count),
                   on_grid.rightCols(count)};
    here.middle = functions(here.centre());
    while (true) {
        const double width = here.end(0) - here.begin(0);
        const ArrayXd centre = here.centre();
        const ArrayXXd distance =
            here.distance().colwise() / least.max(std::numeric_limits<double>::min());
        std::vector<std::pair<double, Index>> kept;
        for (Index k = 0; k < here.size(); ++k) {
            const bool is_finite = distance.col(k).isFinite().all();
            // Late in time the doubles may be no nearer to each other.
            const bool is_last = width <= narrowest * length || !(here.begin(k) < centre(k)) ||
                                 !(centre(k) < here.end(k));
            if (is_last || !is_finite)
                if (const auto jump = jump_in(here, k, functions, length, least))
                    return jump;
            if (const double greatest = distance.col(k).maxCoeff();
                is_finite && !is_last && greatest > halved_from)
                kept.emplace_back(-greatest, k);
        }
        if (kept.empty())
            return std::nullopt;
        std::sort(kept.begin(), kept.end());
        std::vector<Index> first;
        for (std::size_t k = 0; k < std::min(kept.size(), most_intervals); ++k)
            first.push_back(kept[k].second);
        here = here.only(first).halves(functions);
    }
}

std::optional<Jump> find_jump(const FunctionRows& functions, const FunctionRows& exactly,
                              const ArrayXd& grid, double least_distance) {
    return find_jump(functions, grid, least_distance) ? find_jump(exactly, grid, least_distance)
                                                      : std::nullopt;
}

} // namespace tvbeam
