#pragma once

#include "core/point_grid.hpp"
#include "mms/expression/plain_evaluation.hpp"
#include "mms/text/source_text.hpp"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// Values that stand for one formula at several points, and for each the sum of the sizes of the
/// products that it is the sum of; 0 where it is one formula.
struct ComputedValues {
    Eigen::ArrayXd values;
    Eigen::ArrayXd terms;

    /// Of one formula.
    static ComputedValues of(const Eigen::ArrayXd& values);
};

/// The decimal that a double stands for (exact_rational), in long double: 0.017 is 17/1000.
Bounded<long double> written(double value);

/// Points that no user chose: both ends of the beam and two quasi-random points inside, at the end
/// of an interval of time, at two quasi-random times in it and, if asked for, at its beginning.
Points points_to_compare(double begin, double end, bool with_begin);
inline constexpr Eigen::Index points_a_time = 4; ///< x = 0, x = 1, two inside

/// The first point at which what was computed in doubles is not what the text says: where it is
/// further off than 2^-53 times 64 times the first-order bound of rounding — of the text, and of
/// the sum of products — explains. Passed over: points at which the text has no value or one beyond
/// the range of a double that the double shows as infinite, and differences below 1e-25 of the
/// largest bound of all points, or below the smallest normal double.
std::optional<Eigen::Index>
first_disagreement(const std::vector<Bounded<long double>>& text, const ComputedValues& computed,
                   const std::function<bool(Eigen::Index)>& counts = {});

/// That they disagree, in words.
std::string disagreement_text(const std::string& what, double x, double t, double computed,
                              long double text);

/// Throws InputError where the value of an expression without x and t, parsed as `plain`, is not
/// `computed`; `values`: of the names in it.
void require_agreement(const SourceText& source, const std::string& what,
                       const PlainExpression& plain, const std::map<std::string, double>& values,
                       double computed);

} // namespace tvbeam
