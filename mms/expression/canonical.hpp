#pragma once

#include <ginac/ginac.h>

#include <memory>
#include <string>
#include <vector>

namespace tvbeam {

// GiNaC orders the operands of sums and products by addresses, and writes -(1-x) or x-1 as that
// order falls, so that its print and the order of its arithmetic change from one run to the next.
// Here both follow from the expression alone.

struct CanonicalNode;
using Canonical = std::shared_ptr<const CanonicalNode>;

/// An expression with its operands in a fixed order that reads well: in a sum descending powers of
/// x, of t, then by name, the number last; in a product what is constant, then what depends on t,
/// then on x. A sum that is a factor, or the base of an integer power, begins with a positive term;
/// the sign goes to the product's coefficient.
struct CanonicalNode {
    enum class Kind { Number, Name, Sum, Product, Power, Function };

    Kind kind = Kind::Number;
    GiNaC::numeric coefficient =
        1;            ///< a number's value, a product's numerical factor; 1 in the rest
    std::string name; ///< of a symbol, of pi, or of a function
    std::vector<Canonical>
        operands; ///< terms; factors other than the coefficient; base and exponent; argument

    std::string key; ///< equal for equal expressions only
    bool has_x = false;
    bool has_t = false;
    bool has_symbol = false;
};

Canonical canonical(const GiNaC::ex& expression);

/// An exact number as GiNaC writes it: 1/3.
std::string number_text(const GiNaC::numeric& value);

/// The same node with another coefficient; for products and numbers only.
Canonical with_coefficient(const CanonicalNode& node, const GiNaC::numeric& coefficient);

/// The same function with the largest coefficient of every sum that is raised to an integer power
/// 1: GiNaC writes (1 - x/1000)^103 as (1000 - x)^103 over 1e309, here it is itself again.
Canonical rescaled(const Canonical& node);

/// Whether a sum's first term, in that order, is negative: a sum or the one with all signs changed.
bool begins_with_minus(const CanonicalNode& sum);

/// The operands of a sum or product in that order, as GiNaC has them.
GiNaC::exvector ordered_operands(const GiNaC::ex& sum_or_product);

} // namespace tvbeam
