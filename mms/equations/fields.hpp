#pragma once

#include <ginac/ginac.h>

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace tvbeam {

/// The symbols x, y, z, t of equations, the same objects in every expression.
const GiNaC::symbol& coordinate(std::size_t index);
inline constexpr std::size_t coordinate_count = 4;

/// Numbers of derivatives in x, y, z and t.
using Orders = std::array<int, coordinate_count>;

/// An unknown, or a derivative of one, as equations name it: u, u_x, u_xxt.
struct EquationField {
    std::string unknown; ///< a component: u, or v1
    Orders orders{};
    GiNaC::realsymbol symbol; ///< its name is u_xxt
    GiNaC::ex exact;          ///< what it is for the exact solution
};

/// The unknowns, and those derivatives of them that were asked for. Equations are expressions in
/// their symbols, and stay as short as they are written: u_t − k(u_xx + u_yy).
class Fields {
public:
    Fields() = default;
    Fields(const Fields&) = delete; // by_name_ points into fields_
    Fields& operator=(const Fields&) = delete;
    Fields(Fields&&) = default;
    Fields& operator=(Fields&&) = default;
    ~Fields() = default;

    /// A component of an unknown with its exact value; its symbol.
    GiNaC::ex add(const std::string& unknown, const GiNaC::ex& exact);

    /// ∂/∂(coordinate) of an expression in coordinates and fields, by the chain rule. Throws
    /// AlgebraError where it is too large, or a derivative is of an order above 8.
    GiNaC::ex derivative(const GiNaC::ex& expression, std::size_t coordinate);

    /// The field of that name, or null.
    [[nodiscard]] const EquationField* find(const std::string& name) const;
    /// Those that occur, in the order in which they were made.
    [[nodiscard]] std::vector<const EquationField*> occurring_in(const GiNaC::ex& expression) const;
    /// An unknown itself, or a derivative of it.
    const EquationField& of(const std::string& unknown, const Orders& orders);

    /// The expression for the exact solution, in coordinates and parameters. Throws AlgebraError
    /// where it has no value, or is too large.
    [[nodiscard]] GiNaC::ex exact(const GiNaC::ex& expression) const;

private:
    std::deque<EquationField> fields_; ///< which keeps its elements where they are
    std::map<std::string, const EquationField*> by_name_;
};

/// The derivative of an expression without fields. Throws AlgebraError before it is computed where
/// it might have more than 200 000 nodes.
GiNaC::ex plain_derivative(const GiNaC::ex& expression, const GiNaC::symbol& symbol);

} // namespace tvbeam
