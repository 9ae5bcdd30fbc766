#include "studies/scene/scheme_keys.hpp"

#include "studies/scene/toml_reader.hpp"

namespace tvbeam {

Scheme read_scheme_keys(TableReader& table, Scheme scheme) {
    if (const auto algorithm = table.choice("algorithm", {"direct", "fixed-point"}))
        scheme.algorithm = *algorithm == 0 ? Algorithm::direct : Algorithm::fixed_point;
    const auto times = TimeScheme::names();
    if (const auto time = table.choice("time", times))
        scheme.time = TimeScheme::named(times[*time]);
    if (const auto mass = table.choice("thermal_mass", {"consistent", "lumped"}))
        scheme.thermal_mass = *mass == 0 ? ThermalMass::consistent : ThermalMass::lumped;
    if (const auto tolerance = table.number("tolerance")) {
        if (scheme.algorithm != Algorithm::fixed_point)
            throw InputError(table.place("tolerance"),
                             table.full("tolerance") +
                                 " belongs to algorithm = \"fixed-point\"; "
                                 "the direct algorithm does not iterate: remove it");
        if (!(*tolerance > 0.0))
            throw InputError(table.place("tolerance"), table.full("tolerance") + " is " +
                                                           message_text(*tolerance) +
                                                           "; it must be > 0");
        scheme.tolerance = *tolerance;
    }
    if (const auto basis = table.choice("basis", {"automatic", "nodal"})) {
        if (scheme.algorithm != Algorithm::direct)
            throw InputError(table.place("basis"),
                             table.full("basis") + " belongs to algorithm = \"direct\"; the "
                                                   "paper's has its nodal values only: remove it");
        scheme.basis = *basis == 0 ? Basis::automatic : Basis::nodal;
    }
    return scheme;
}

} // namespace tvbeam
