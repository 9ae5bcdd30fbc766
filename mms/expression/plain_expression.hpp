#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// One step of an expression as it is written.
struct PlainStep {
    enum class Kind { Number, Name, Add, Subtract, Multiply, Divide, Negate, Power, Function };
    Kind kind;
    std::string text; ///< the digits of a number; the name of a symbol or a function
};

/// An expression in the order in which its text says that it is evaluated, operands first: `1-x*t`
/// is 1 x t * -. No rule of algebra has touched it.
using PlainExpression = std::vector<PlainStep>;

} // namespace tvbeam
