#pragma once

#include <ginac/ginac.h>

#include <utility>
#include <vector>

namespace tvbeam {

/// τ(t) φ(x)
struct SeparatedProduct {
    GiNaC::ex amplitude; ///< τ, with the numerical factor and the sign
    GiNaC::ex profile;   ///< φ, normalised
};

/// g(x,t) = Σ τ_r(t) φ_r(x) + rest(x,t). Every profile appears once; a zero function has neither
/// products nor rest.
struct Separation {
    std::vector<SeparatedProduct> products;
    GiNaC::ex rest;
};

/// Separates an expression in x and t of model_symbols() by its structure: sums term by term,
/// products factor by factor. Factors that depend on both are distributed if they are sums or
/// powers of sums (exponent 8 at most), exp and powers of constants of a sum are split into
/// factors, sin, cos, sinh and cosh of a sum by their addition theorems; a term with any other
/// mixed factor goes to the rest. What depends on x only or on t only is left as it is written:
/// (x-1)^10 stays. If more than 32 products arise, all is rest.
Separation separated(const GiNaC::ex& expression);

/// c and φ with profile = c φ, where φ is the same for x-1, 1-x and 3*(1-x): the leading terms of
/// its sums have coefficient 1 and it has no constant factors. The profile depends on x only.
std::pair<GiNaC::ex, GiNaC::ex> normalised_profile(const GiNaC::ex& profile);

} // namespace tvbeam
