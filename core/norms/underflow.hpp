#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"

#include <limits>
#include <string>
#include <vector>

namespace tvbeam {

/// The least square of which a rounding unit is still a number.
inline constexpr double least_square =
    std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();

/// Why the errors of a run are not known: norms are roots of sums of squares, and the squares of
/// differences below 1e-146 are no numbers of full precision (IEEE 754: least normal number
/// 2.2e-308), those below 1e-162 are zero. Empty where no error has come so low. An error of zero
/// is one where the exact solution is zero or no such number: its fields at 64 places and its
/// stress, at 17 times or, of a computed one, at the end. errors: in the order of norms. data.exact
/// must be set.
std::string underflow(const ProblemData& data, const std::vector<Norm>& norms,
                      const std::vector<double>& errors, double final_time);

} // namespace tvbeam
