#include "studies/scene/scene_keys.hpp"

#include "core/certify/stated_scheme.hpp"
#include "core/time/time_scheme.hpp"
#include "mms/equations/code.hpp"
#include "studies/orders/order_tuning.hpp"
#include "studies/scene/expectation_keys.hpp"

#include <fmt/format.h>

#include <iterator>

namespace tvbeam {

namespace {

using Entries = std::vector<KeyEntry>;

const std::vector<std::string> masses{"consistent", "lumped"};
const std::vector<std::string> algorithms{"direct", "fixed-point"};

Entries of_the_whole() {
    return {
        {"title", KeyType::text, "the file's name", "what the result is headed by"},
        {"solution", KeyType::text, "a block [data]",
         "the exact solution: a shipped name, or a file relative to the scene, \"./mine.toml\""},
        {"gate", KeyType::flag, "false",
         "that it is there for what the program says and refuses: listed by itself"},
        {"long", KeyType::flag, "false",
         "that it may take more than 6 hours on one core, or 4 GB, as is predicted"},
    };
}

Entries of_the_beam() {
    return {
        {"beam", KeyType::table, "", "the beam; a scene has this block or [solver]"},
        {"beam.alpha", KeyType::number, KeyEntry::required,
         "thermal expansion, without unit, >= 0; 0: heat and bending are two problems"},
        {"beam.zeta", KeyType::number, KeyEntry::required, "viscosity, a time, >= 0"},
        {"beam.theta_A", KeyType::number, "0", "temperature at the clamped end"},
        {"beam.stops", KeyType::numbers, "no stops",
         "[g1, g2], g1 < 0 < g2, between which the tip moves; -inf or inf: none on that side"},
        {"beam.contact", KeyType::table, "rigid stops", "how the stops give way"},
        {"beam.contact.law", KeyType::choice, "rigid", "of the stops", {"rigid", "penalty"}},
        {"beam.contact.epsilon", KeyType::number, "required by penalty",
         "by how much a stop yields to a unit force, > 0"},
        {"scheme", KeyType::table, "its defaults", "how the beam is computed"},
        {"scheme.algorithm", KeyType::choice, "direct",
         "direct: the moment form, without iteration; fixed-point: the paper's", algorithms},
        {"scheme.time", KeyType::choice, "euler", "the time scheme; bdf2 and sdirk2 are of order 2",
         TimeScheme::names()},
        {"scheme.thermal_mass", KeyType::choice, "consistent",
         "the mass matrix of the heat equation", masses},
        {"scheme.tolerance", KeyType::number, "1e-7",
         "of the fixed point: the largest change of a nodal value in its last iteration, > 0"},
        {"scheme.basis",
         KeyType::choice,
         "automatic",
         "of the direct algorithm; automatic: in sines where the mesh is uniform and it is faster",
         {"automatic", "nodal"}},
        {"mesh", KeyType::table, "uniform meshes", "where the nodes are: one of its two keys"},
        {"mesh.grading", KeyType::number, "1",
         "> 0: nodes at (j/s)^grading, 2 for finer elements at the clamped end"},
        {"mesh.nodes", KeyType::numbers, "none",
         "from 0 to 1, increasing; every mesh has these, and divides each interval evenly"},
        {"data", KeyType::table, "a solution", "a problem without exact solution"},
        {"data.theta0", KeyType::expression, "0",
         "temperature at t = 0, in x; if given, theta_A at x = 0 and 0 at x = 1"},
        {"data.u0", KeyType::expression, "0", "deflection at t = 0, in x"},
        {"data.heat_source", KeyType::expression, "0", "f(x, t)"},
        {"data.body_force", KeyType::expression, "0", "q(x, t) in sigma_x = q"},
        {"reference", KeyType::table, "the exact solution",
         "errors are measured against a run as fine as this"},
        {"reference.elements", KeyType::integer, KeyEntry::required,
         "a multiple of every number of elements in the studies that measure errors"},
        {"reference.dt", KeyType::number, KeyEntry::required, "divides every dt in these"},
        {"reference.richardson", KeyType::flag, "false",
         "extrapolate from it and two coarser runs to what they tend to"},
        {"defect", KeyType::table, "none",
         "a deliberate defect: what every run adds to the problem"},
        {"defect.theta0", KeyType::expression, "0", "added to the temperature at t = 0"},
        {"defect.u0", KeyType::expression, "0", "added to the deflection at t = 0"},
        {"defect.heat_source", KeyType::expression, "0", "added to f"},
        {"defect.body_force", KeyType::expression, "0", "added to q"},
        {"defect.moment_load", KeyType::expression, "0", "added to the moment load G, in x and t"},
    };
}

Entries of_the_solver() {
    return {
        {"solver", KeyType::table, "",
         "a program of your own, run once a level in place of the beam"},
        {"solver.command", KeyType::texts, KeyEntry::required,
         "the program and its arguments, no shell; {elements}, {h}, {dt}, {steps}, {final_time}, "
         "{level} and the parameters are filled in, {{ is a brace"},
        {"solver.files", KeyType::texts, "none",
         "copied to the directory of each run; NAME.in is filled in as the command is and becomes "
         "NAME"},
        {"solver.errors", KeyType::patterns, "none",
         "errors by name: a regular expression with one group for lines of standard output; or a "
         "file that the program writes, NAME.json or NAME.csv"},
        {"solver.errors.NAME", KeyType::text, "", "its expression"},
        {"solver.values", KeyType::patterns, "none", "the same for numbers without known limit"},
        {"solver.values.NAME", KeyType::text, "", "its expression"},
        {"solver.seconds", KeyType::text, "the process is timed",
         "a regular expression for the program's own clock"},
        {"solver.timeout", KeyType::number, "none", "seconds that a run may take, > 0"},
        {"solver.environment", KeyType::table, "none", "variables that a run finds set"},
        {"solver.environment.NAME", KeyType::word, "", "its value"},
        {"solver.parameters", KeyType::table, "none", "more placeholders, with their usual values"},
        {"solver.parameters.NAME", KeyType::word, "", "its usual value"},
        {"solver.solution", KeyType::text, "none",
         "a file of equations, or a shipped one, whose formulas templates take: {source.NAME}, "
         "{exact.NAME}, {boundary.NAME}, {initial.NAME}, {parameter.NAME}, {functions}"},
        {"solver.language", KeyType::choice, "required with solution", "in which those are written",
         code_language_names()},
    };
}

Entries of_ladders_and_grids() {
    return {
        {"ladder", KeyType::table, "", "one problem on finer and finer levels"},
        {"ladder.final_time", KeyType::number, "required for the beam", "when the runs end, > 0"},
        {"ladder.elements", KeyType::integers, "required for the beam", "of each level"},
        {"ladder.dt", KeyType::steps, "required for the beam",
         "the time step of each level, or all as one expression in s, the elements: \"0.01/s\""},
        {"ladder.norms", KeyType::texts, "none",
         "errors to measure: theta_L2L2, theta_LinfL2, theta_L2H1, u_LinfL2, u_LinfH1, u_LinfH2, "
         "u_LinfH2semi, u_L2H2, sigma_L2, each also squared with _sq behind it, and corollary; or "
         "names of [solver.errors]"},
        {"ladder.values", KeyType::texts, "none", "names of [solver.values]"},
        {"ladder.printed", KeyType::table, "none", "published errors and values to compare with"},
        {"ladder.printed.source", KeyType::text, "published", "where they were published"},
        {"ladder.printed.NORM", KeyType::numbers, "none", "one a level"},
        {"ladder.until", KeyType::table, "the levels that are given",
         "add levels until the order is known, or a budget is spent: one of seconds and levels at "
         "least"},
        {"ladder.until.order", KeyType::number, "none",
         fmt::format("half of the 95 % interval that the order is to have, > {}",
                     OrderTuning().narrowest)},
        {"ladder.until.limit", KeyType::number, "none", "the same for the limit of a value, > 0"},
        {"ladder.until.seconds", KeyType::number, "none", "that all runs may take, > 0"},
        {"ladder.until.levels", KeyType::integer, "none", "that the ladder may come to have"},
        {"orders", KeyType::table, "",
         "a grid, elements x dt, to which a h^p + b dt^q + ... is fitted"},
        {"orders.final_time", KeyType::number, "required for the beam", "when the runs end, > 0"},
        {"orders.elements", KeyType::integers, KeyEntry::required, "the meshes"},
        {"orders.dt", KeyType::numbers, KeyEntry::required,
         "the time steps, each run on every mesh"},
        {"orders.norms", KeyType::texts, "required without values",
         "as in [ladder], without squares"},
        {"orders.values", KeyType::texts, "none", "names of [solver.values]"},
        {"orders.until", KeyType::table, "the grid that is given",
         "add meshes and steps until both orders are known, or a budget is spent: one of seconds "
         "and runs at least"},
        {"orders.until.order", KeyType::number, "none",
         fmt::format("half of the 95 % intervals that both orders are to have, > {}",
                     OrderTuning().narrowest)},
        {"orders.until.limit", KeyType::number, "none", "the same for the limit of a value, > 0"},
        {"orders.until.seconds", KeyType::number, "none", "that all runs may take, > 0"},
        {"orders.until.runs", KeyType::integer, "none", "that the grid may come to have"},
        {"work_precision", KeyType::table, "",
         "the run times of schemes for the errors that they reach"},
        {"work_precision.final_time", KeyType::number, "required for the beam",
         "when the runs end, > 0"},
        {"work_precision.norms", KeyType::texts, KeyEntry::required, "as in [ladder]"},
        {"work_precision.runs", KeyType::integer, "20",
         "timed ones of each level; of those above 25 ms as many as fill half a second, five at "
         "least"},
        {"work_precision.targets", KeyType::table, "powers of ten alone",
         "errors at which times are compared, too"},
        {"work_precision.targets.NORM", KeyType::numbers, "none", "errors of this norm"},
        {"work_precision.scheme", KeyType::tables, KeyEntry::required,
         "the schemes, each with a ladder of its own"},
        {"work_precision.scheme.name", KeyType::text, "from its keys", "what it is called"},
        {"work_precision.scheme.elements", KeyType::integers, "required for the beam",
         "as in [ladder]"},
        {"work_precision.scheme.dt", KeyType::steps, "required for the beam", "as in [ladder]"},
        {"work_precision.scheme.algorithm", KeyType::choice, "as in [scheme]", "as there",
         algorithms},
        {"work_precision.scheme.time", KeyType::choice, "as in [scheme]", "as there",
         TimeScheme::names()},
        {"work_precision.scheme.thermal_mass", KeyType::choice, "as in [scheme]", "as there",
         masses},
        {"work_precision.scheme.tolerance", KeyType::number, "as in [scheme]", "as there"},
        {"work_precision.scheme.basis",
         KeyType::choice,
         "as in [scheme]",
         "as there",
         {"automatic", "nodal"}},
        {"work_precision.scheme.parameters", KeyType::table, "as in [solver]",
         "those of [solver], with other values"},
        {"work_precision.scheme.parameters.NAME", KeyType::word, "as in [solver]", "its value"},
    };
}

Entries of_other_studies() {
    return {
        {"evolution", KeyType::table, "", "one run over time"},
        {"evolution.final_time", KeyType::number, KeyEntry::required, "when the run ends, > 0"},
        {"evolution.elements", KeyType::integer, KeyEntry::required, "of its mesh"},
        {"evolution.dt", KeyType::number, KeyEntry::required, "its time step"},
        {"evolution.probes", KeyType::texts, KeyEntry::required,
         "what is looked at: theta@X and u@X with X from 0 to 1, stress, energy, which is half of "
         "the integrals of (theta - theta_A*(1 - x))^2, with the lumped mass matrix as a sum over "
         "the nodes, and of u_xx^2"},
        {"evolution.every", KeyType::integer, "1", "steps from one sample to the next"},
        {"evolution.period", KeyType::number, "none",
         "compare each period of this length with that before it"},
        {"sensitivity", KeyType::table, "", "how small a defect the scene's expectations catch"},
        {"sensitivity.range", KeyType::band, "[1e-8, 1]",
         "of the factors that the defects are scaled by"},
        {"sensitivity.defect", KeyType::table, KeyEntry::required, "the defects by name"},
        {"sensitivity.defect.NAME",
         KeyType::table,
         KeyEntry::required,
         "with the keys of [defect]",
         {},
         "defect"},
        {"stress", KeyType::table, "", "many cases over decades, each judged from outside"},
        {"stress.sweep", KeyType::table, "none", "sweeps by name"},
        {"stress.sweep.NAME", KeyType::table, "none",
         "lists of parameters, from which cases are made"},
        {"stress.sweep.NAME.alpha", KeyType::numbers, "[0.5]", "as beam.alpha"},
        {"stress.sweep.NAME.zeta", KeyType::numbers, "[0.1]", "as beam.zeta"},
        {"stress.sweep.NAME.theta_A", KeyType::numbers, "[0]", "as beam.theta_A"},
        {"stress.sweep.NAME.gap", KeyType::numbers, "[inf]",
         "between the tip and a stop, > 0; inf: no stops"},
        {"stress.sweep.NAME.sides",
         KeyType::words,
         "[\"both\"]",
         "where the stops are",
         {"both", "lower", "upper"}},
        {"stress.sweep.NAME.load", KeyType::numbers, "[1]", "the size of the loads, >= 0"},
        {"stress.sweep.NAME.initial",
         KeyType::words,
         "[\"zero\"]",
         "the initial data",
         {"zero", "smooth", "rough", "random"}},
        {"stress.sweep.NAME.elements", KeyType::integers, "[10]", "of the meshes"},
        {"stress.sweep.NAME.dt", KeyType::numbers, "[0.01]", "time steps, > 0"},
        {"stress.sweep.NAME.time", KeyType::words, "[\"euler\"]", "as scheme.time",
         stated_schemes()},
        {"stress.sweep.NAME.thermal_mass", KeyType::words, "[\"consistent\"]",
         "as scheme.thermal_mass", masses},
        {"stress.sweep.NAME.algorithm", KeyType::words, "[\"direct\"]", "as scheme.algorithm",
         algorithms},
        {"stress.sweep.NAME.sampling",
         KeyType::choice,
         "each",
         "each: one list at a time, the others at their first values; product: all combinations; "
         "sobol: some, evenly",
         {"each", "product", "sobol"}},
        {"stress.sweep.NAME.points", KeyType::integer, "100", "how many cases sobol takes"},
        {"stress.sweep.NAME.steps", KeyType::integer, "20", "of a case, at most"},
        {"stress.sweep.NAME.work", KeyType::integer, "2000000",
         "elements times steps of a case, at most, but for its first two steps"},
        {"stress.contraction", KeyType::table, "none",
         "a map of the fixed point's contraction over alpha and dt"},
        {"stress.contraction.alpha", KeyType::table, KeyEntry::required, "values in equal ratios"},
        {"stress.contraction.alpha.from", KeyType::number, KeyEntry::required, "the first, > 0"},
        {"stress.contraction.alpha.to", KeyType::number, KeyEntry::required, "the last, > 0"},
        {"stress.contraction.alpha.count", KeyType::integer, "20", "how many"},
        {"stress.contraction.dt",
         KeyType::table,
         KeyEntry::required,
         "values in equal ratios",
         {},
         "stress.contraction.alpha"},
        {"stress.contraction.zeta", KeyType::number, "0.1", "as beam.zeta"},
        {"stress.contraction.elements", KeyType::integer, "20", "of the mesh"},
        {"stress.contraction.time", KeyType::choice, "euler", "as scheme.time",
         TimeScheme::names()},
        {"stress.contraction.thermal_mass", KeyType::choice, "consistent", "as scheme.thermal_mass",
         masses},
        {"stress.roundoff", KeyType::table, "none",
         "the floors of round-off over the number of elements"},
        {"stress.roundoff.alpha", KeyType::number, "0.3", "as beam.alpha, > 0"},
        {"stress.roundoff.zeta", KeyType::number, "0.1", "as beam.zeta"},
        {"stress.roundoff.dt", KeyType::number, "0.001", "the time step, > 0"},
        {"stress.roundoff.steps", KeyType::integer, "3", "of a run"},
        {"stress.roundoff.time", KeyType::choice, "euler", "as scheme.time", stated_schemes()},
        {"stress.roundoff.thermal_mass", KeyType::choice, "consistent", "as scheme.thermal_mass",
         masses},
        {"stress.roundoff.elements", KeyType::integers, "[10]", "of the meshes"},
        {"stress.roundoff.finest_hermite", KeyType::integer, "10000",
         "elements beyond which the Hermite form is not run"},
    };
}

Entries of_what_is_written() {
    return {
        {"short",
         KeyType::table,
         "the scene itself",
         "what replaces keys of the same path in `tvbeam check --short`",
         {},
         "."},
        {"report", KeyType::table, "all but pgfplots", "what --out writes"},
        {"report.files", KeyType::texts, "all but pgfplots",
         "json, csv, markdown, latex, plots, pdf, pgfplots, html"},
    };
}

Entries all_entries() {
    Entries all;
    for (auto&& part : {of_the_whole(), of_the_beam(), of_the_solver(), of_ladders_and_grids(),
                        of_other_studies(), expectation_keys(), of_what_is_written()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

} // namespace

const KeyTable& scene_keys() {
    static const KeyTable keys(all_entries());
    return keys;
}

} // namespace tvbeam
