#pragma once

#include "mms/equations/program.hpp"

#include <functional>
#include <string>

namespace tvbeam {

/// How a language writes what programs consist of.
struct InfixStyle {
    std::string number_ending = {}; ///< of a literal: _dp
    bool decimal_point = true;      ///< 2.0 in place of 2
    std::string power = {};         ///< ** or ^; empty: a function pow
    std::string function_prefix = {};
};

/// The text of a step. `named`: the name of a step that has one, otherwise empty; never asked for
/// the step itself.
std::string infix_text(const Program& program, int step, const InfixStyle& style,
                       const std::function<std::string(int)>& named);

/// As expressions are read, at most so long.
std::string readable_text(const Program& program, int step, std::size_t longest);

/// A double as short as it can be, with a point where the style asks for it.
std::string literal_text(double value, const InfixStyle& style);

} // namespace tvbeam
