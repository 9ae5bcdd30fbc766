#pragma once

#include "mms/text/source_text.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tvbeam {

/// A named expression as it stands in the file; more than one: a vector by its components.
struct NamedEntries {
    std::string name;
    Place place; ///< of the name
    std::vector<SourceText> entries;
};

/// A value on a part of the boundary.
struct BoundaryEntry {
    NamedEntries value;
    std::string variable; ///< x, y or z; empty: the value is for all of the boundary
    SourceText position;  ///< of the plane: variable = position
};

struct DomainInterval {
    double begin = 0.0;
    double end = 1.0;
};

/// Equations of one's own and a solution of them, as a file gives them:
///
///     name    = "heat-2d"              # optional; the file's name otherwise
///     source  = "…"                    # optional: where it was published
///     purpose = "…"                    # optional: one line on what it is for
///     dimension = 2                    # optional: of space; otherwise by the coordinates named
///     [parameters]
///     k = 1                            # a number, or a string: an expression of numbers and pi
///     [unknowns]
///     u = "sin(pi*x)*sin(pi*y)*cos(t)" # vectors: v = ["…", "…"]; what stands before may be used
///     [definitions]                    # optional: abbreviations, in the order of the file
///     flux = "-k*grad(u)"
///     [equations]
///     f = "diff(u, t) + div(flux)"     # its value at the solution is the source of that name
///     [boundary]                       # optional
///     right = { on = "x = 1", value = "k*diff(u, x)" }
///     [initial]                        # optional: at the beginning of the domain's t
///     u = "u"
///     [domain]                         # optional; 0 to 1 for what is not named
///     x = [0, 2]
///
/// Expressions are those of solutions (expression_parser.hpp) with x, y, z, t, the parameters, the
/// unknowns and definitions, and besides
///
///     [a, b, c]                        vectors, whose components are v1, v2; of vectors: matrices
///                                      by rows; identity
///     diff(e, x), diff(e, x, 2), diff(e, x, 2, t)
///     grad(e): (grad v)_ij = ∂_j v_i;  div(v);  div(A)_i = Σ_j ∂_j A_ij;  laplace(e)
///     curl(v): in space a vector; of a vector in the plane ∂_x v2 − ∂_y v1, of a scalar (∂_y,
///     −∂_x) dot(v, w), dot(A, v), dot(v, A), dot(A, B);  inner(A, B) = Σ A_ij B_ij;  outer(v,
///     w)_ij = v_i w_j sym(A) = (A + Aᵀ)/2;  trace(A);  transpose(A)
struct EquationSystem {
    std::string file;
    std::string name;
    std::string source;
    std::string purpose;
    int dimension = 1;
    std::vector<std::string> coordinates; ///< those of x, y, z, t that the file names
    std::vector<NamedEntries> parameters;
    std::vector<NamedEntries> unknowns;
    std::vector<NamedEntries> definitions;
    std::vector<NamedEntries> equations;
    std::vector<BoundaryEntry> boundary;
    std::vector<NamedEntries> initial;
    std::map<std::string, DomainInterval> domain; ///< of every coordinate
};

/// Whether a file is one of equations: TOML with a key `equations`. Throws InputError where it
/// cannot be read.
bool is_equation_system(const std::filesystem::path& file);

/// Reads such a file. Throws InputError at file:line:column for whatever breaks a rule of the file;
/// expressions are read where they are derived.
EquationSystem read_equation_system(const std::filesystem::path& file);

/// The same for a document at hand; `file` is the name that errors carry.
EquationSystem parse_equation_system(std::string_view document, const std::string& file);

} // namespace tvbeam
