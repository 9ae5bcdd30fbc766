#pragma once

#include "core/problem.hpp"
#include "mms/solution.hpp"

#include <string>
#include <vector>

namespace tvbeam {

/// A formula derived from a solution, with the beam's symbols and the parameters left as symbols.
struct DerivedFormula {
    std::string symbol;   ///< "f", "G", "q", "m", "sigma", "theta0" or "u0"
    std::string interval; ///< the times it holds for, e.g. "0 <= t <= sqrt(2)" or "t > sqrt(2)";
                          ///< "t >= 0": always; "t = 0" for the last two
    std::string interval_latex; ///< the same in LaTeX's mathematical mode
    std::string text;           ///< reads back with the parser of the solution files
    std::string latex;
};

/// What (1), (2), (3), (9) and the initial conditions become for a solution:
///
///     f = θ̃_t − θ̃_xx − α u_xxt,   G = σ̃ + u_xxx + ζ u_xxxt + α θ̃_x,   q = σ̃_x,
///     m = u_xx(1,t) + ζ u_xxt(1,t),   theta0 = θ̃(x,0),   u0 = u(x,0)
///
/// Where the stops are penalised and σ̃ is not given, it stands as `sigma` in G, and its law behind:
/// sigma(1,t) = −((u(1,t) − g2)⁺ − (g1 − u(1,t))⁺)/ε, a text that does not read back.
///
/// f, G, q and m once for each phase, in the order of the phases, q if it is not zero in all of
/// them; then theta0 and u0 of the first phase. The same text in every run. Throws InputError where
/// an expression is too large to be differentiated.
std::vector<DerivedFormula> derived_formulas(const Solution& solution,
                                             bool penalised_stops = false);

/// How far these texts, read again with the beam's numbers, are from what a run of the solution up
/// to final_time is driven by: for each symbol the greatest difference on a grid of [0,1] × its
/// times over its greatest value there (or 1e-12 of that of all symbols, where that is more); of
/// all symbols the greatest. A body force that is not printed stands for 0. A G that holds `sigma`
/// and points without a value are passed over. Throws InputError as derive_on does, and where a
/// text cannot be read.
double distance_of_formulas(const Solution& solution, const Beam& beam, double final_time);

} // namespace tvbeam
