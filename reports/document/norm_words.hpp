#pragma once

#include <string>

namespace tvbeam {

/// A norm's name in words: "theta_L2L2_sq" is "temperature in L²(0,T; L²), squared". The name
/// itself where it is none of Norm::names().
std::string norm_words(const std::string& name);

} // namespace tvbeam
