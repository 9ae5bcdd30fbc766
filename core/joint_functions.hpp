#pragma once

#include "core/problem.hpp"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

namespace tvbeam {

/// (x, t) ↦ (g_0(x,t), g_1(x,t), …) at points (x_i, t_i), x and t of one size; shape: functions ×
/// points.
using JointFunctions =
    std::function<Eigen::ArrayXXd(const Eigen::ArrayXd& x, const Eigen::ArrayXd& t)>;

/// Functions that share parts: those of these numbers in one, in which what they share is computed
/// once. An empty result: they are not to be had together.
using FunctionFamily = std::function<JointFunctions(const std::vector<Eigen::Index>& members)>;

/// A SpaceTimeFunction that knows the family it is of.
struct FamilyMember {
    SpaceTimeFunction alone;
    std::shared_ptr<const FunctionFamily> family;
    Eigen::Index number;

    Eigen::ArrayXd operator()(const Eigen::ArrayXd& x, double t) const { return alone(x, t); }
};

/// Whether both are the same member of one family.
bool are_same(const SpaceTimeFunction& one, const SpaceTimeFunction& other);

/// The functions in one: together if they are of one family, else each by itself.
JointFunctions in_one(const std::vector<SpaceTimeFunction>& functions);

} // namespace tvbeam
