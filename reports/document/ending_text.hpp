#pragma once

#include "studies/scene/until.hpp"

#include <string>

namespace tvbeam {

/// Why a ladder or a grid was refined no further, and what is not known; a sentence. size: what it
/// came to, "6 levels".
std::string ending_text(const Refined& refined, const Until& until, const std::string& size);

} // namespace tvbeam
