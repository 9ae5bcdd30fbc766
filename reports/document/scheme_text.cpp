#include "reports/document/scheme_text.hpp"

#include "reports/document/number_text.hpp"

#include <algorithm>
#include <cctype>

namespace tvbeam {

namespace {

std::string time_scheme_text(const TimeScheme& scheme) {
    if (scheme.name == "euler")
        return "implicit Euler";
    std::string text = scheme.name;
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

} // namespace

std::string scheme_text(const Scheme& scheme) {
    std::string line = scheme.algorithm == Algorithm::direct
                           ? "direct algorithm"
                           : "fixed-point algorithm, tolerance " + shortest(scheme.tolerance);
    return line + ", " + time_scheme_text(scheme.time) + ", " + name_of(scheme.thermal_mass) +
           " heat mass matrix";
}

} // namespace tvbeam
