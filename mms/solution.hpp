#pragma once

#include "mms/text/source_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// One phase in time of an exact solution, as text. It holds for t ≤ until and after the phase
/// before it; the last phase has no `until` and holds for all later times.
struct SolutionPhase {
    std::optional<SourceText> until; ///< a time: an expression of constants and parameters
    SourceText theta;                ///< θ̃(x,t)
    SourceText u;                    ///< u(x,t)
    std::optional<SourceText> sigma; ///< σ̃(x,t), at x = 1 the contact stress; may be absent
};

/// A named number of a solution, its value an expression of constants.
struct SolutionParameter {
    std::string name;
    SourceText value;
};

/// An exact solution, as a file gives it:
///
///     name   = "…"                      # optional; the file's name otherwise
///     source = "…"                      # optional: where it was published
///     purpose = "…"                     # optional: one line on what it is for
///     theta  = "…"                      # θ̃, u and sigma: at the top, for all phases, or in each
///     [parameters]
///     k = 3                             # a number, or a string: an expression of numbers and pi
///     [[phase]]
///     until = "sqrt(2)"                 # in every phase but the last; positive and increasing
///     u     = "…"
///     sigma = "…"                       # σ̃(x,t); where it is left out 0, and where the stops of
///                                       # the beam are penalised what their law makes of u(1,t)
///
/// sigma is the stress σ̃ of (2), (3): at x = 1 it is the contact stress of (7), (8), and where it
/// depends on x a body force q = σ̃_x drives the beam.
///
/// Expressions know x, t, alpha, zeta, g1, g2, theta_A, pi and the parameters; + - * / ^; sin cos
/// tan asin acos atan sinh cosh tanh exp log sqrt. Every expression of a Solution that came from
/// the readers below parses.
struct Solution {
    std::string name;
    std::string source;
    std::string purpose;
    std::vector<SolutionParameter> parameters;
    std::vector<SolutionPhase> phases; ///< at least one
};

/// Reads a solution file. Throws InputError at file:line:column for whatever breaks a rule, a
/// missing file included.
Solution read_solution(const std::filesystem::path& path);

/// The same for a document at hand; `file` is the name that errors carry.
Solution parse_solution(std::string_view document, const std::string& file);

} // namespace tvbeam
