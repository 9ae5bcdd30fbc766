#pragma once

#include "mms/equations/derived_system.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// What there is to say of a file of equations that is no error.
struct Remark {
    Place place;
    std::string text;
};

/// Examines a derived system on its domain (EquationSystem::domain), before anything of it is used:
///
/// - an equation that the solution meets already: its source is zero everywhere
/// - a term that the solution does not exercise: a derivative in an equation is zero everywhere
/// - a parameter without effect
/// - poles and kinks: where a divisor is zero, or the argument of log, sqrt, tan, asin, acos or of
///   a power leaves what it is smooth on. Looked for at a grid of points with the ends of the
///   domain, and excluded by interval arithmetic on parts of it; what is neither found nor excluded
///   is said.
///
/// "Everywhere" is decided by the algebra, or at 64 quasi-random points within the bounds of
/// rounding. Throws InputError where an exact value itself has no value in the domain.
std::vector<Remark> checked_system(DerivedSystem& derived);

/// The last of it alone: what is refused, without what is only said.
void require_exact_values(DerivedSystem& derived);

/// A point of the domain: values of the coordinates.
using DomainPoint = std::map<std::string, double>;

/// Quasi-random points inside (the additive recurrence of the plastic number's kind).
std::vector<DomainPoint> points_inside(const EquationSystem& system, std::size_t count);

/// The values of all names at a point: coordinates, parameters and pi.
std::map<std::string, long double> names_at(const DerivedSystem& derived, const DomainPoint& point);

} // namespace tvbeam
