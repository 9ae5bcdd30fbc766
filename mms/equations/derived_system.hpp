#pragma once

#include "mms/equations/equation_system.hpp"
#include "mms/equations/fields.hpp"

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// A function of the coordinates that is derived from a file of equations.
struct DerivedFunction {
    enum class Role { source, exact, gradient, boundary, initial };
    Role role;
    std::string name;   ///< in code: f, u_exact, u_exact_x, flux, u_initial
    std::string of;     ///< in the file, by component: f, u, flux
    std::string place;  ///< of a boundary or initial value: "x = 1", "t = 0"; may be empty
    std::string origin; ///< the text that it comes of
    Place source;       ///< where that stands
    /// In coordinates, parameters and fields; of boundary and initial values in the coordinates and
    /// parameters that remain.
    GiNaC::ex formula;
    std::map<std::string, double> at; ///< the coordinate of the place, as a number
};

struct DerivedParameter {
    std::string name;
    GiNaC::realsymbol symbol;
    GiNaC::ex exact;
    double value = 0.0;
    /// It makes the exponent of something that varies, or is negative, whole, and its number stands
    /// for it everywhere: x^n is smooth at x = 0 for n = 3, and n x^n/x has a value there.
    bool is_number = false;
};

/// Equations with all that follows from their exact solution.
struct DerivedSystem {
    EquationSystem system;
    std::vector<DerivedParameter> parameters;
    Fields fields;
    std::vector<std::string> unknowns; ///< by component
    std::vector<DerivedFunction> functions;

    [[nodiscard]] std::vector<const DerivedFunction*> of_role(DerivedFunction::Role role) const;
};

/// Derives the sources, the exact values with their gradients, and the boundary and initial values.
/// Throws InputError where an expression breaks a rule, where there are fewer equations than
/// unknowns, an unknown that no equation has, or an equation without unknowns.
DerivedSystem derive_system(const EquationSystem& system);

} // namespace tvbeam
