#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace tvbeam {

/// Functions of one variable; shape: one row a function, one column a point.
using FunctionRows = std::function<Eigen::ArrayXXd(const Eigen::ArrayXd& s)>;

/// A place where a function jumps.
struct Jump {
    Eigen::Index row; ///< which function
    double at;
    double size; ///< from before it to behind it
};

/// What is a jump within a phase, over the largest value: less where a formula may have one
/// (may_jump); elsewhere a layer would be one, and below this the rounding of large terms that
/// cancel.
constexpr double least_jump(bool is_expected) {
    return is_expected ? 5e-5 : 1e-3;
}

/// Parts of an interval, at each of which the other coordinate is searched for a jump. A jump is
/// one nearly always and everywhere, so that three are enough where none is to be expected; where a
/// formula may have one, it may be seen for a while.
Eigen::ArrayXd parts_to_search(bool is_expected);

/// The ends, and points between them that no round number halves: of most formulas that jump there,
/// a place has no value.
Eigen::ArrayXd uneven_grid(double begin, double end);

/// A jump, the largest at its place, of the functions on a grid, by halving the intervals in which
/// they are furthest from linear: the distance of the middle from the mean of both ends falls with
/// the length to the power of two, at a kink to the power of one, and at a jump it stays. A layer
/// thinner than a hundred millionth of the grid is one. None is found below 2 `least_distance` of
/// the largest value on the grid. Right at a jump a formula may have no value.
std::optional<Jump> find_jump(const FunctionRows& functions, const Eigen::ArrayXd& grid,
                              double least_distance);

/// A jump that is one of `exactly`, too, which has more digits: no step of rounding, where large
/// terms cancel.
std::optional<Jump> find_jump(const FunctionRows& functions, const FunctionRows& exactly,
                              const Eigen::ArrayXd& grid, double least_distance);

} // namespace tvbeam
