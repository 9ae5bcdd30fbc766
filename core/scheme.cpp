#include "core/scheme.hpp"

namespace tvbeam {

std::string name_of(Algorithm algorithm) {
    return algorithm == Algorithm::direct ? "direct" : "fixed-point";
}

std::string name_of(ThermalMass mass) {
    return mass == ThermalMass::lumped ? "lumped" : "consistent";
}

} // namespace tvbeam
