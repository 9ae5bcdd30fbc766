#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <string>

namespace tvbeam {

// The nearest change that makes a wrong solution admissible, as the ends of messages.

/// What to take from the expression called `from` so that it loses `excess`, a function of x and t:
/// "subtract t*x/100 from u", or "add exp(-t)*x to theta"; in words, the excess called `name`,
/// where its formula is long.
std::string subtraction(const GiNaC::ex& excess, const std::string& name, const std::string& from);

/// The number rounded towards zero, or away from it, to four significant digits, so that a limit
/// given by it is kept and not just missed.
double rounded_in(double value);
double rounded_out(double value);

/// A time in (begin, end) at which the state, different at both ends, changes; to rounding.
double switch_time(const std::function<bool(double t)>& state, double begin, double end);

/// The time in (begin, end], the nearest to the one that is wanted, where a distance ≥ 0 that is
/// sampled there comes down to the tolerance, in as few digits, 6 or more, as keep it there; none:
/// it does not.
std::optional<std::string> meeting_time(const std::function<double(double t)>& distance,
                                        double begin, double end, double wanted, double tolerance);

} // namespace tvbeam
