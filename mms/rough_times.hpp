#pragma once

#include "mms/solution_expressions.hpp"

#include <Eigen/Core>

#include <vector>

namespace tvbeam {

/// Times within a phase, in order, at which the base of a power that is no integer is zero all over
/// the beam, as of sqrt((t - a)^2) or, in its derivative, asin(cos(t - a)): the rates of θ̃ and u
/// may jump there, or have an infinite slope, and their formulas may have no value. Seen where the
/// base is least on a grid, and zero there.
std::vector<double> rough_times(const PhaseExpressions& phase, double final_time);

/// How far functions jump across such a time: from a side of it to the other, at 1e-7 of a length
/// from it, or nothing where that is less than at 1e-6 or 1e-5, as of what is smooth or has a slope
/// without a bound: at one of these it may cancel with the rest. at: their values at a time; shape:
/// one row a function, one column a place.
template <typename At>
Eigen::ArrayXXd jump_across(const At& at, double t, double length) {
    constexpr double beside = 1e-7;
    constexpr double same = 0.8;
    const auto difference = [&](double part) -> Eigen::ArrayXXd {
        return at(t + part * length) - at(t - part * length);
    };
    Eigen::ArrayXXd jump = difference(beside);
    const Eigen::ArrayXXd change = difference(1e-6).abs().max(difference(1e-5).abs());
    for (Eigen::Index row = 0; row < jump.rows(); ++row)
        if (!(jump.row(row).abs().maxCoeff() > same * change.row(row).maxCoeff()))
            jump.row(row) = 0.0;
    return jump;
}

} // namespace tvbeam
