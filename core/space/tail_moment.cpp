#include "core/space/tail_moment.hpp"

#include "core/space/quadrature.hpp"

#include <algorithm>

namespace tvbeam {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

namespace {

/// ∫ q dx and ∫ (x − left) q dx of parts of [0, 1]; shape: 2 × parts.
Eigen::Array2Xd moments(const SpaceFunction& q, const ArrayXd& left, const ArrayXd& length) {
    const GaussRule& rule = element_rule();
    const ArrayXXd offsets = (rule.points.matrix() * length.matrix().transpose()).array();
    const ArrayXXd weighted = at_points(q, offsets.rowwise() + left.transpose()) *
                              (rule.weights.matrix() * length.matrix().transpose()).array();
    Eigen::Array2Xd result(2, left.size());
    result << weighted.colwise().sum(), (weighted * offsets).colwise().sum();
    return result;
}

} // namespace

ArrayXd tail_moment(const std::vector<Interval>& intervals, const SpaceFunction& q,
                    const ArrayXd& y) {
    const auto count = static_cast<Index>(intervals.size());
    ArrayXd left(count);
    ArrayXd length(count);
    for (Index i = 0; i < count; ++i) {
        left(i) = intervals[static_cast<std::size_t>(i)].left;
        length(i) = intervals[static_cast<std::size_t>(i)].length;
    }
    // From the right: ∫ q and ∫ (x − left_i) q over [left_i, 1].
    Eigen::Array2Xd tails = Eigen::Array2Xd::Zero(2, count + 1);
    const Eigen::Array2Xd whole = moments(q, left, length);
    for (Index i = count; i-- > 0;) {
        tails(0, i) = tails(0, i + 1) + whole(0, i);
        tails(1, i) = tails(1, i + 1) + length(i) * tails(0, i + 1) + whole(1, i);
    }
    ArrayXd rest(y.size()); // from y to the end of its interval
    std::vector<Index> next(static_cast<std::size_t>(y.size()));
    for (Index k = 0; k < y.size(); ++k) {
        const Index i = std::upper_bound(left.begin() + 1, left.end(), y(k)) - left.begin();
        next[static_cast<std::size_t>(k)] = i;
        rest(k) = std::max(0.0, left(i - 1) + length(i - 1) - y(k));
    }
    const ArrayXd within = moments(q, y, rest).row(1).transpose();
    const Eigen::Array2Xd behind = tails(Eigen::all, next);
    return within + rest * behind.row(0).transpose() + behind.row(1).transpose();
}

} // namespace tvbeam
