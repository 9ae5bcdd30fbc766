#include "studies/scene/scheme_keys.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/runs/beam_runs.hpp"

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
            throw table.error("tolerance", " belongs to algorithm = \"fixed-point\"; "
                                           "the direct algorithm does not iterate: remove it");
        if (!(*tolerance > 0.0))
            throw table.error("tolerance", " is " + message_text(*tolerance) + "; it must be > 0");
        scheme.tolerance = *tolerance;
    }
    if (const auto basis = table.choice("basis", {"automatic", "nodal"})) {
        if (scheme.algorithm != Algorithm::direct)
            throw table.error("basis", " belongs to algorithm = \"direct\"; the "
                                       "paper's has its nodal values only: remove it");
        scheme.basis = *basis == 0 ? Basis::automatic : Basis::nodal;
    }
    return scheme;
}

SolverKeys beam_keys(const Scheme& own) {
    SolverKeys keys;
    for (const auto& root : Norm::names())
        for (const auto& name : {root, root + "_sq"})
            if (const auto norm = Norm::named(name))
                keys.measures.push_back(measure_of(*norm));
    keys.read_method = [own](TableReader& table) {
        return method_of(read_scheme_keys(table, own));
    };
    return keys;
}

} // namespace tvbeam
