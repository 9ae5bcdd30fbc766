#pragma once

#include <ginac/ginac.h>

#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tvbeam {

/// What cannot be computed exactly in reasonable time and size, or is not a real number. Its text
/// is a sentence for the user without the place, which the caller knows.
class AlgebraError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// GiNaC evaluates constants exactly as soon as they meet: 2^(10^10) never ends, and a substitution
// can make such a power out of a harmless expression. Whatever the user's text reaches goes through
// these, which refuse in time and let no exception but AlgebraError out.

/// a + b, a − b, a b, a / b.
GiNaC::ex checked_sum(const GiNaC::ex& a, const GiNaC::ex& b);
GiNaC::ex checked_difference(const GiNaC::ex& a, const GiNaC::ex& b);
GiNaC::ex checked_product(const GiNaC::ex& a, const GiNaC::ex& b);
GiNaC::ex checked_quotient(const GiNaC::ex& a, const GiNaC::ex& b);

/// base^exponent. A numerical exponent is at most 1000 in size, and of a constant base no power may
/// need more than 8192 bits. A denominator has no bound: such powers remain what they are.
GiNaC::ex checked_power(const GiNaC::ex& base, const GiNaC::ex& exponent);

/// The functions of one argument that expressions may use.
const std::vector<std::string>& function_names();
GiNaC::ex checked_function(const std::string& name, const GiNaC::ex& argument);

/// The expression with symbols replaced by values.
GiNaC::ex substituted(const GiNaC::ex& expression, const GiNaC::exmap& values);

/// The number that an expression is with these values, exactly; nothing where it is none, or has no
/// value.
std::optional<GiNaC::numeric> number_with(const GiNaC::ex& expression, const GiNaC::exmap& values);

/// ∂/∂s, refused when it has more than 20 000 nodes.
GiNaC::ex derivative(const GiNaC::ex& expression, const GiNaC::symbol& s);

/// The expression with products and powers of sums multiplied out, each root as a whole: of some,
/// GiNaC::ex::expand takes factors with a sign out and puts them in again, without an end.
GiNaC::ex expanded(const GiNaC::ex& expression);

/// The expression with products and powers of sums multiplied out, if about 500 terms at most come
/// of it; otherwise, and where powers of it are beyond what can be counted, the expression as it
/// is.
GiNaC::ex moderately_expanded(const GiNaC::ex& expression);

/// Whether the expression is zero after expansion of products and powers of sums; false if that
/// cannot be decided at moderate size.
bool is_identically_zero(const GiNaC::ex& expression);

/// The rational that the shortest decimal of a finite double stands for: 0.017 is 17/1000.
GiNaC::numeric exact_rational(double value);

/// Whether the expression, or a derivative of it, may jump somewhere: it has a quotient, a root, a
/// logarithm, or a function that has one of these for a derivative, of what is no number.
bool may_jump(const GiNaC::ex& expression);

/// Whether the symbol occurs.
bool depends_on(const GiNaC::ex& expression, const GiNaC::symbol& s);

} // namespace tvbeam
