#pragma once

#include "core/joint_functions.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace tvbeam {

/// Functions of space and time on [0,1] × (begin, end], each as its Chebyshev coefficients of x by
/// rows and of t by columns, all of one shape.
struct ExpandedPiece {
    double begin;
    double end;
    std::vector<Eigen::MatrixXd> coefficients;
};

/// All of (0, T], piece after piece.
struct Expansion {
    std::vector<ExpandedPiece> pieces;
    Eigen::ArrayXd greatest; ///< max |g| of each function, as sampled
    std::string reason;      ///< why there is none; empty: there is one
};

/// The place in [−1, 1] of a time of a piece.
inline double place_in(double begin, double end, double t) {
    return (2.0 * t - begin - end) / (end - begin);
}

/// Expands functions that are smooth in each of the intervals between `ends` (from 0 on,
/// increasing). An interval is halved where it takes too high a degree of t.
Expansion expanded(const JointFunctions& functions, Eigen::Index count,
                   const std::vector<double>& ends);

} // namespace tvbeam
