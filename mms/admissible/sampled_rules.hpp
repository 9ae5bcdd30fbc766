#pragma once

#include "core/problem.hpp"
#include "mms/sample_points.hpp"
#include "mms/text/input_error.hpp"

#include <Eigen/Core>

#include <string>

namespace tvbeam {

// The rules of an exact solution (admissibility.hpp), and of given data, on sampled values,
// whatever computes them. An InputError stands at `place` and begins with `what`.

/// Of an equality, to the largest value on the grid.
inline constexpr double relative_tolerance = 1e-12;
inline constexpr Eigen::Index time_points = 257; ///< for what depends on time only

/// The largest |g(x, t)| on the grid: grid_points in [0, 1], the times given. Throws InputError
/// where g is not finite, with the time from which on it is not, or grows without bound next to a
/// local maximum of |g| at the time, or in the place, of the largest, as at a pole; final_time is
/// that of the whole run. exists: what is asked of g everywhere.
double largest_on_grid(const SpaceTimeFunction& g, const Eigen::ArrayXd& times, double final_time,
                       const Place& place, const std::string& what,
                       const std::string& exists = "it and its derivatives exist");

/// That a function of time is `value`: its differences from it, one a time, are within the
/// tolerance; the greatest is said. rule: what it must be, and the repair.
void require_value(const Eigen::ArrayXd& differences, const Eigen::ArrayXd& times, double value,
                   double tolerance, const Place& place, const std::string& what,
                   const std::string& rule);

/// A quantity that jumps between two phases, in words; the repair is to follow.
std::string jump_text(const std::string& what, double jump, double t, double x);

} // namespace tvbeam
