#pragma once

#include "core/scheme.hpp"

#include <string>

namespace tvbeam {

/// A scheme in words: "direct algorithm, implicit Euler, lumped heat mass matrix".
std::string scheme_text(const Scheme& scheme);

} // namespace tvbeam
