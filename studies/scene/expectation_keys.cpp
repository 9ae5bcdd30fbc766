#include "studies/scene/expectation_keys.hpp"

#include "core/time/time_scheme.hpp"
#include "mms/equations/code.hpp"

#include <fmt/format.h>

namespace tvbeam {

namespace {

using Entries = std::vector<KeyEntry>;

Entries of_expectations() {
    return {
        {"expect", KeyType::table, "nothing", "what `tvbeam check` holds the result against"},
        {"expect.left_out", KeyType::texts, "anything",
         "all that is left out, by what stands before the colon"},
        {"expect.remarks", KeyType::texts, "anything",
         "what the result says of all studies, each sentence by how it begins"},
        {"expect.law_distance", KeyType::band, "anything",
         "by how much a solution of rigid stops misses the law of penalised ones, a length"},
        {"expect.quadrature", KeyType::table, "anything",
         "of the intervals that the functions of the problem are integrated on"},
        {"expect.quadrature.intervals", KeyType::band, "anything", "how many there are"},
        {"expect.quadrature.finest", KeyType::band, "anything", "the length of the shortest"},
        {"expect.separation", KeyType::table, "anything",
         "of the products that stand for what does not separate"},
        {"expect.separation.rank", KeyType::band, "anything", "how many; 0: none do"},
        {"expect.separation.residual", KeyType::band, "anything",
         "by how much they differ from it, over its greatest value"},
        {"expect.reference", KeyType::table, "anything", "of the block [reference]"},
        {"expect.reference.elements", KeyType::numbers, "anything",
         "of the runs that it is made of"},
        {"expect.reference.dt", KeyType::numbers, "anything", "of the same runs"},
        {"expect.reference.times", KeyType::numbers, "anything",
         "the first and the last at which it is known"},
        {"expect.reference.levels", KeyType::band, "anything", "how many times there are"},
        {"expect.ladder", KeyType::table, "anything", "of the ladder"},
        {"expect.ladder.ended_by", KeyType::texts, "anything", "what ended a ladder with `until`"},
        {"expect.ladder.open", KeyType::texts, "anything",
         "what a ladder with `until` leaves unknown"},
        {"expect.ladder.elements", KeyType::numbers, "anything",
         "those of the levels that a ladder with `until` came to"},
        {"expect.ladder.dt", KeyType::numbers, "anything",
         "those of the levels that a ladder with `until` came to"},
        {"expect.ladder.remarks", KeyType::texts, "anything",
         "what it says of all norms: quadrature, nearness to a reference"},
        {"expect.ladder.counters", KeyType::table, "anything", "what the runs did, so many times"},
        {"expect.ladder.counters.NAME", KeyType::numbers, "anything",
         "one a level; heat_solves, beam_solves, contact_steps and others of the JSON result"},
        {"expect.ladder.NORM", KeyType::table, "anything", "of a norm or a value of the ladder"},
        {"expect.ladder.NORM.remarks", KeyType::texts, "anything",
         "what the orders mean, each sentence by how it begins"},
        {"expect.ladder.NORM.orders", KeyType::band, "anything", "every observed order"},
        {"expect.ladder.NORM.errors", KeyType::numbers, "anything", "one a level"},
        {"expect.ladder.NORM.within", KeyType::number, "0.001",
         "the part of itself by which an error may differ, > 0 and at most 0.5"},
        {"expect.ladder.NORM.ratios", KeyType::bands, "anything",
         "of the errors to those in [ladder.printed]; for all levels or one a level"},
        {"expect.ladder.NORM.verdicts", KeyType::texts, "anything",
         "one a level, as asymptotic, pre-asymptotic, cancellation, floor"},
        {"expect.ladder.NORM.predicted", KeyType::band, "anything",
         "of the errors to what [orders] predicts"},
        {"expect.ladder.NORM.predicted_place", KeyType::band, "anything",
         "where in the predicted interval an error lies, from 0 to 1"},
        {"expect.ladder.NORM.order", KeyType::band, "anything",
         "the order along the ladder, of the norm, not its square, where it has [solver] or "
         "`until`"},
        {"expect.ladder.NORM.order_determined", KeyType::flag, "anything",
         "whether that order is known"},
        {"expect.ladder.NORM.order_holds", KeyType::number, "anything",
         "what the 95 % interval of that order must hold"},
        {"expect.ladder.NORM.order_half_width", KeyType::band, "anything",
         "half of the 95 % interval of that order"},
        {"expect.ladder.NORM.limit", KeyType::band, "anything",
         "the limit of a value of [solver.values]"},
        {"expect.ladder.NORM.limit_determined", KeyType::flag, "anything",
         "whether the limit of a value is known"},
        {"expect.ladder.NORM.limit_holds", KeyType::number, "anything",
         "what the 95 % interval of the limit of a value must hold"},
        {"expect.ladder.NORM.limit_half_width", KeyType::band, "anything",
         "half of the 95 % interval of the limit of a value"},
        {"expect.ladder.NORM.uncertainty", KeyType::band, "anything",
         "that of the finest value of [solver.values]"},
        {"expect.ladder.NORM.gci", KeyType::table, "anything",
         "what the grid convergence index says of a value"},
        {"expect.ladder.NORM.gci.limit", KeyType::band, "anything", "its limit"},
        {"expect.ladder.NORM.gci.uncertainty", KeyType::band, "anything",
         "its uncertainty of the finest value"},
        {"expect.ladder.NORM.gci.order", KeyType::band, "anything", "its order"},
        {"expect.ladder.NORM.celik", KeyType::table, "anything",
         "what the procedure of Celik et al. (2008) says of a value"},
        {"expect.ladder.NORM.celik.limit", KeyType::band, "anything", "its limit"},
        {"expect.ladder.NORM.celik.uncertainty", KeyType::band, "anything",
         "its uncertainty of the finest value"},
        {"expect.ladder.NORM.celik.order", KeyType::band, "anything", "its order"},
        {"expect.ladder.NORM.eca_hoekstra", KeyType::table, "anything",
         "what least squares by Eça and Hoekstra (2014) say of a value"},
        {"expect.ladder.NORM.eca_hoekstra.limit", KeyType::band, "anything", "its limit"},
        {"expect.ladder.NORM.eca_hoekstra.uncertainty", KeyType::band, "anything",
         "its uncertainty of the finest value"},
        {"expect.ladder.NORM.eca_hoekstra.order", KeyType::band, "anything", "its order"},
        {"expect.orders", KeyType::table, "anything", "of the fits of [orders]"},
        {"expect.orders.ended_by", KeyType::texts, "anything", "what ended a grid with `until`"},
        {"expect.orders.open", KeyType::texts, "anything",
         "what a grid with `until` leaves unknown"},
        {"expect.orders.elements", KeyType::numbers, "anything",
         "those of the meshes that a grid with `until` came to"},
        {"expect.orders.dt", KeyType::numbers, "anything",
         "the steps that a grid with `until` came to"},
        {"expect.orders.NORM", KeyType::table, "anything", "of a norm of [orders]"},
        {"expect.orders.NORM.p", KeyType::band, "anything", "the order in h"},
        {"expect.orders.NORM.p_determined", KeyType::flag, "anything", "whether it is known"},
        {"expect.orders.NORM.p_holds", KeyType::number, "anything",
         "what its 95 % interval must hold"},
        {"expect.orders.NORM.p_half_width", KeyType::band, "anything", "half of that interval"},
        {"expect.orders.NORM.q", KeyType::band, "anything", "the order in dt"},
        {"expect.orders.NORM.q_determined", KeyType::flag, "anything", "whether it is known"},
        {"expect.orders.NORM.q_holds", KeyType::number, "anything",
         "what its 95 % interval must hold"},
        {"expect.orders.NORM.q_half_width", KeyType::band, "anything", "half of that interval"},
        {"expect.orders.NORM.a", KeyType::band, "anything",
         "the fitted size of h^p, also where it is not known"},
        {"expect.orders.NORM.b", KeyType::band, "anything",
         "the fitted size of dt^q, also where it is not known"},
        {"expect.orders.NORM.rho", KeyType::band, "anything", "of both; below 0: they cancel"},
        {"expect.orders.NORM.forecast", KeyType::number, "anything",
         "the part of itself by which a or b may differ from its forecast, > 0 and at most 0.5"},
        {"expect.orders.NORM.left_out", KeyType::texts, "anything",
         "the runs that the fit leaves out, each with its reason"},
        {"expect.orders.NORM.limit", KeyType::band, "anything",
         "the limit of a value of [solver.values]"},
        {"expect.orders.NORM.limit_determined", KeyType::flag, "anything",
         "whether the limit of a value is known"},
        {"expect.orders.NORM.limit_holds", KeyType::number, "anything",
         "what the 95 % interval of the limit of a value must hold"},
        {"expect.orders.NORM.limit_half_width", KeyType::band, "anything",
         "half of the 95 % interval of the limit of a value"},
        {"expect.orders.NORM.uncertainty", KeyType::band, "anything",
         "that of the finest value of [solver.values]"},
        {"expect.orders.NORM.constant", KeyType::band, "anything",
         "of the norm corollary: the greatest constant of Corollary 2.2"},
        {"expect.orders.NORM.least_constant", KeyType::band, "anything",
         "of the norm corollary: the least constant over the grid"},
        {"expect.orders.NORM.finest_constant", KeyType::band, "anything",
         "of the norm corollary: the constant of the finest run"},
        {"expect.work_precision", KeyType::table, "anything", "of timed schemes by name"},
        {"expect.work_precision.NAME", KeyType::table, "anything", "of a scheme"},
        {"expect.work_precision.NAME.counters", KeyType::table, "anything",
         "as in [expect.ladder]"},
        {"expect.work_precision.NAME.counters.NAME", KeyType::numbers, "anything",
         "as in [expect.ladder.counters]"},
        {"expect.work_precision.NAME.NORM", KeyType::table, "anything", "of a norm of it"},
        {"expect.work_precision.NAME.NORM.orders", KeyType::band, "anything",
         "every observed order"},
        {"expect.work_precision.NAME.NORM.errors", KeyType::numbers, "anything", "one a level"},
        {"expect.work_precision.NAME.NORM.within", KeyType::number, "0.001",
         "as in [expect.ladder.NORM]"},
        {"expect.work_precision.sooner", KeyType::tables, "anything",
         "how much sooner one scheme reaches an error than another"},
        {"expect.work_precision.sooner.norm", KeyType::text, KeyEntry::required,
         "of which the error is"},
        {"expect.work_precision.sooner.error", KeyType::number, KeyEntry::required,
         "that both reach: a power of ten, or one of the targets"},
        {"expect.work_precision.sooner.faster", KeyType::text, KeyEntry::required,
         "the name of a scheme"},
        {"expect.work_precision.sooner.slower", KeyType::text, KeyEntry::required, "of another"},
        {"expect.work_precision.sooner.ratio", KeyType::band, "anything",
         "of the time of slower over that of faster"},
        {"expect.work_precision.sooner.distinguishable", KeyType::flag, "anything",
         "whether their times have a ratio above 1.2, and quartiles that are apart"},
        {"expect.evolution", KeyType::table, "anything", "of the evolution"},
        {"expect.evolution.events", KeyType::texts, "anything",
         "all of them: \"onset g2\", \"release g2\""},
        {"expect.evolution.FIGURE", KeyType::band, "anything",
         "\"PROBE.least\", .greatest, .first, .last, .mean, .error, .period_change; samples, "
         "onsets, releases, \"onset.1\", \"release.1\", \"beyond.1\" (how far into the stop the "
         "first contact goes), beyond_stops, period_change"},
        {"expect.sensitivity", KeyType::table, "anything", "of the sensitivity study"},
        {"expect.sensitivity.FIGURE", KeyType::band, "anything",
         "a defect's name: the factor that is first caught; 0 where that is the smallest of the "
         "range, as a "
         "lesser one may be caught as well"},
        {"expect.stress", KeyType::table, "anything", "of the stress study"},
        {"expect.stress.FIGURE", KeyType::band, "anything",
         "certified, refused, stopped, failed, cases, the first four of a regime (\"time "
         "bdf2.refused\"); CHECK.count, .least and .greatest of energy, heat_residual, "
         "beam_residual, penetration, wrong_sign, complementarity, initial_state, fixed_point, "
         "path, error, order_defect; of the other tables those that a message lists where a name "
         "is none"},
    };
}

Entries of_what_is_derived() {
    Entries entries;
    const auto add_of_each_scheme = [&](const std::string& table, KeyType type,
                                        const std::string& meaning) {
        for (const auto& time : TimeScheme::names())
            entries.push_back({fmt::format("{}.{}", table, time), type, "anything", meaning});
    };
    entries = {
        {"expect.derive", KeyType::table, "anything",
         "what theory says of the solution before any run, as `tvbeam derive` prints it"},
        {"expect.derive.exercises", KeyType::texts, "anything",
         "terms that the solution exercises, by their names there"},
        {"expect.derive.untested", KeyType::texts, "anything", "terms that it leaves untested"},
        {"expect.derive.largest", KeyType::table, "anything", "how large terms become, by name"},
        {"expect.derive.largest.TERM", KeyType::band, "anything", "of a term"},
        {"expect.derive.residual", KeyType::table, "anything",
         "the residuals of the finest mesh and step that are shown"},
        {"expect.derive.residual.heat in space", KeyType::band, "anything", "of the heat equation"},
        {"expect.derive.residual.beam in space", KeyType::band, "anything", "of the beam equation"},
        {"expect.derive.residual.heat in time", KeyType::band, "anything",
         "with the scene's own scheme"},
        {"expect.derive.residual.beam in time", KeyType::band, "anything", "likewise"},
        {"expect.derive.reasons", KeyType::texts, "anything",
         "all reasons of the orders, each by how it begins"},
        {"expect.derive.formulas_within", KeyType::number, "anything",
         "how far the printed formulas, read again, may be from what runs, as a part of the "
         "greatest"},
        {"expect.derive.exact", KeyType::texts, "anything",
         "equations that leave no residual, with any scheme: \"heat in space\", \"beam in time\""},
        {"expect.derive.space_residual", KeyType::band, "anything",
         "the last orders of the residual in space, of the heat and of the beam equation"},
        {"expect.derive.time_residual", KeyType::table, "anything",
         "the same in time, by time scheme"},
    };
    add_of_each_scheme("expect.derive.time_residual", KeyType::band, "of this time scheme");
    entries.insert(
        entries.end(),
        {{"expect.derive.NORM", KeyType::table, "anything", "of a norm of the table of orders"},
         {"expect.derive.NORM.h", KeyType::word, "anything",
          "the order to expect in h: 2, \"1 to 2\", \"-\" without an error, \"not known\""}});
    add_of_each_scheme("expect.derive.NORM", KeyType::word, "that in dt of this time scheme");
    entries.insert(entries.end(), {{"expect.derive.NORM.a", KeyType::band, "anything",
                                    "the size to expect of h^p, with the scene's mass matrix"},
                                   {"expect.derive.NORM.b", KeyType::table, "anything",
                                    "the size to expect of dt^q, by time scheme"}});
    add_of_each_scheme("expect.derive.NORM.b", KeyType::band, "of this time scheme");
    return entries;
}

Entries of_what_is_refused() {
    return {
        {"expect.refused", KeyType::tables, "anything",
         "changes with which the scene is refused before anything runs, or a run of it fails, or "
         "an expectation among them is violated"},
        {"expect.refused.set", KeyType::texts, "nothing",
         "the keys that are changed: \"KEY=VALUE\""},
        {"expect.refused.solution", KeyType::text, "the scene's",
         "the text of a solution that stands in its place"},
        {"expect.refused.says", KeyType::texts, KeyEntry::required,
         "words that the message holds, all of them"},
    };
}

Entries of_what_is_analysed() {
    return {
        {"expect.analyse", KeyType::tables, "anything",
         "tables of anyone's errors or values, and what `tvbeam analyse` finds in them"},
        {"expect.analyse.file", KeyType::text, KeyEntry::required,
         "the table, relative to the scene"},
        {"expect.analyse.size", KeyType::texts, "h or elements",
         "columns of mesh widths, or of numbers of cells, unknowns, ..."},
        {"expect.analyse.dimension", KeyType::number, "sizes are widths",
         "sizes are numbers n of what fills a domain of this dimension d: h = n^(-1/d)"},
        {"expect.analyse.step", KeyType::text, "dt", "the column of time steps"},
        {"expect.analyse.error", KeyType::texts, "error", "columns of errors"},
        {"expect.analyse.value", KeyType::texts, "value, where there are no errors",
         "columns of computed numbers whose limit is not known"},
        {"expect.analyse.sigma", KeyType::text, "not known",
         "the column of standard deviations of the figures"},
        {"expect.analyse.where", KeyType::texts, "all rows",
         "only rows whose column has this text or number: \"scheme=Euler\"; \"seed=*\": rows "
         "that the column tells apart are one series"},
        {"expect.analyse.holds", KeyType::text, KeyEntry::required,
         "what is expected of the columns, as `tvbeam analyse --expect` takes it: \"L2.order = "
         "[1.9, 2.1]\""},
    };
}

Entries of_equations() {
    return {
        {"expect.equations", KeyType::tables, "anything",
         "systems of equations, and what `tvbeam derive` says of them"},
        {"expect.equations.file", KeyType::text, "text",
         "a shipped name, or a file, relative to the scene"},
        {"expect.equations.text", KeyType::text, "file", "the text of such a file"},
        {"expect.equations.language", KeyType::choice, "none: the report",
         "in which `says` is sought", code_language_names()},
        {"expect.equations.says", KeyType::texts, "anything",
         "words of what is derived, or of its code in a language"},
        {"expect.equations.remarks", KeyType::texts, "anything",
         "what is said of it besides, each sentence by how it begins"},
        {"expect.equations.refused", KeyType::texts, "that it is not",
         "words of the message by which it is refused"},
    };
}

Entries of_commands() {
    return {
        {"expect.commands", KeyType::tables, "anything",
         "commands of tvbeam, one after the other in one directory, which is empty at first"},
        {"expect.commands.run", KeyType::texts, KeyEntry::required, "the words that follow tvbeam"},
        {"expect.commands.files", KeyType::table, "none", "what is written there before"},
        {"expect.commands.files.NAME", KeyType::text, "", "the text of the file"},
        {"expect.commands.exit", KeyType::integer, "0", "the code that it ends with"},
        {"expect.commands.says", KeyType::texts, "anything",
         "words of what it writes to standard output and error"},
    };
}

} // namespace

std::vector<KeyEntry> expectation_keys() {
    Entries all;
    for (auto&& part : {of_expectations(), of_what_is_derived(), of_what_is_refused(),
                        of_what_is_analysed(), of_equations(), of_commands()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

} // namespace tvbeam
