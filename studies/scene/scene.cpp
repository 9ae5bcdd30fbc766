#include "studies/scene/scene.hpp"

#include "core/norms/error_norms.hpp"
#include "mms/manufactured_problem.hpp"
#include "mms/text/toml_reader.hpp"
#include "studies/data/analysed_expectation.hpp"
#include "studies/external/external_runs.hpp"
#include "studies/gates/command_expectation.hpp"
#include "studies/gates/derived_expectation.hpp"
#include "studies/gates/equations_expectation.hpp"
#include "studies/gates/refused_expectation.hpp"
#include "studies/reference/reference_solution.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/scene/model_keys.hpp"
#include "studies/scene/scene_keys.hpp"
#include "studies/scene/scheme_keys.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/study.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>

namespace tvbeam {

namespace {

Scheme read_scheme(TableReader table) {
    Scheme scheme = read_scheme_keys(table, {});
    table.finish();
    return scheme;
}

Solution read_scene_solution(TableReader& root, const std::filesystem::path& beside) {
    return read_solution(
        find_file(Shipped::solution, *root.text("solution"), beside, root.place("solution")));
}

/// The shortest element against the longest, below which a mesh is refused: half the digits.
constexpr double least_ratio = 1e-8;

/// Runs that are added for the beam are on uniform meshes, against the exact solution.
void check_until(const Scene& scene, const TableReader& root) {
    for (const auto& [kind, block] : scene.blocks.entries())
        for (const char* key : {"mesh", "reference", "defect", "sensitivity"})
            if (kind->until(block) != nullptr && root.has(key))
                throw InputError(root.place(key), kind->name() + ".until adds runs, for which " +
                                                      key + " is not made; remove one of the two");
}

/// Meshes that the studies of the scene cannot have.
void check_meshes(const Scene& scene, const TableReader& root) {
    if (scene.reference && !scene.mesh.is_uniform())
        throw InputError(root.place("mesh"),
                         "a block [reference] wants uniform meshes, whose nodes are all nodes of "
                         "the reference; remove the block [mesh]");
    const auto intervals = static_cast<std::int64_t>(scene.mesh.nodes.size()) - 1;
    std::int64_t finest = 0;
    for (const auto& series : scene.series())
        for (const Rung& rung : series.rungs) {
            if (intervals > 0 && rung.elements % intervals != 0)
                throw InputError(root.place("mesh"),
                                 "mesh.nodes has " + std::to_string(intervals) +
                                     " intervals, and a run has " + std::to_string(rung.elements) +
                                     " elements; every interval must get the same number");
            finest = std::max(finest, rung.elements);
        }
    if (scene.mesh.is_uniform() || finest == 0)
        return;
    // Of graded meshes the finest has the greatest factor, of the others all have the same.
    const std::string repair =
        intervals > 0 ? "give mesh.nodes that are further apart" : "grade less";
    Eigen::ArrayXd lengths;
    try {
        lengths = scene.mesh.with(finest).lengths;
    } catch (const std::invalid_argument& error) {
        throw InputError(root.place("mesh"), std::string(error.what()) + ": " + repair);
    }
    if (!(lengths.minCoeff() >= least_ratio * lengths.maxCoeff()))
        throw InputError(root.place("mesh"),
                         "with " + std::to_string(finest) + " elements the shortest is " +
                             message_text(lengths.minCoeff()) + " and the longest " +
                             message_text(lengths.maxCoeff()) +
                             "; they must be within a factor of 1e8: " + repair);
}

std::string json_of(const toml::table& table) {
    std::ostringstream text;
    // What is beyond ASCII stays: escaped, a character beyond 16 bits would be no JSON.
    text << toml::json_formatter{table, toml::format_flags::quote_infinities_and_nans |
                                            toml::format_flags::allow_unicode_strings};
    return text.str();
}

/// The kinds of study that the scene has blocks of.
std::vector<const StudyKind*> kinds_in(const TableReader& root) {
    std::vector<const StudyKind*> kinds;
    for (const auto& kind : study_kinds())
        if (root.has(kind->name()))
            kinds.push_back(kind.get());
    return kinds;
}

/// Who names a solution in place of a scene is told so, before its keys are said to be unknown.
void require_scene(const TomlDocument& document) {
    const auto& table = document.table;
    if (table.contains("beam") || table.contains("solver"))
        return;
    if (table.contains("theta") || table.contains("u") || table.contains("phase"))
        throw InputError({document.file},
                         "is a solution, not a scene; a scene names it: solution = \"./" +
                             std::filesystem::path(document.file).filename().string() +
                             "\" (tvbeam new writes both)");
}

/// [beam], [mesh], [scheme] and the solution or [data]. wanted: some study runs the problem.
void read_problem(Scene& scene, TableReader& root, bool wanted, const Reading& reading) {
    const bool own_problem = reading.own_problem;
    const std::filesystem::path path(scene.file);
    auto beam = root.table("beam");
    if (!beam && wanted)
        throw InputError({scene.file},
                         "the block [beam] is missing; it holds alpha, zeta and the stops; or "
                         "a block [solver], of a program of your own");
    if (beam)
        scene.beam = read_beam(*std::move(beam));
    if (auto mesh = root.table("mesh"))
        scene.mesh = read_mesh(*std::move(mesh));
    if (auto scheme = root.table("scheme"))
        scene.scheme = read_scheme(*std::move(scheme));

    auto data = root.table("data");
    if (own_problem && (data || root.has("solution")))
        throw InputError(root.place(data ? "data" : "solution"),
                         "the program that reads the scene brings its problem with it; remove the "
                         "scene's");
    if (!own_problem && data && root.has("solution"))
        throw InputError(root.place("data"),
                         "the scene has both a solution and a [data] block; remove one");
    if (wanted && !own_problem && !data && !root.has("solution"))
        throw InputError(root.place("solution"),
                         "the scene has neither a solution nor a [data] block; give one of them");
    if (data)
        scene.problem = read_data(*std::move(data));
    else if (reading.unrun)
        static_cast<void>(root.text("solution"));
    else if (root.has("solution"))
        scene.problem = read_scene_solution(root, path.parent_path());
}

/// The studies of which the short form makes the runs that it names, and no more: those that it has
/// a block of, without an `until` of its own.
std::set<std::string> naming_runs_in_short(const TomlDocument& document) {
    std::set<std::string> names;
    if (const toml::table* shorter = document.table["short"].as_table())
        for (const auto& [name, block] : *shorter)
            if (block.is_table() && !block.as_table()->contains("until"))
                names.emplace(name.str());
    return names;
}

/// [solver], and nothing that is about the beam.
void read_solver_of(Scene& scene, TableReader& root, bool formulas) {
    std::vector<std::string> foreign{"beam",     "mesh",      "scheme", "data",
                                     "solution", "reference", "defect"};
    for (const auto& kind : study_kinds())
        if (!kind->measures())
            foreign.push_back(kind->name());
    for (const auto& key : foreign)
        if (root.has(key))
            throw InputError(
                root.place(key),
                key + " is of a scene of the beam, and this one has a block [solver]; " +
                    (key == "reference" ? "leave it out and let the program print values: their "
                                          "limit is estimated from the levels, with its interval"
                                        : "remove one of the two"));
    scene.solver = read_solver(*root.table("solver"),
                               std::filesystem::path(scene.file).parent_path(), formulas);
}

/// The blocks of the studies.
void read_studies(Scene& scene, TableReader& root) {
    const SolverKeys keys = scene.solver ? solver_keys(*scene.solver) : beam_keys(scene.scheme);
    std::string known;
    for (const auto& kind : study_kinds()) {
        if (auto table = root.table(kind->name()))
            scene.blocks.set(*kind, kind->read(*table, keys));
        known += (known.empty() ? "[" : ", [") + kind->name() + "]";
    }
    if (scene.blocks.entries().empty())
        throw InputError({scene.file}, "the scene has no study; add one of the blocks " + known);
}

/// What errors are measured against: the exact solution, or the block [reference].
void read_reference(Scene& scene, TableReader& root) {
    const auto& entries = scene.blocks.entries();
    const auto measures = [](const ByKind::Entry& entry) { return entry.kind->measures(); };
    if (root.has("reference") && std::none_of(entries.begin(), entries.end(), measures))
        throw InputError(root.place("reference"),
                         "the errors of a [ladder] or of [orders] are measured against a "
                         "reference, and the scene has neither; add one, or remove the block");
    for (const auto& entry : entries)
        if (entry.kind->timed() && (!scene.has_exact_solution() || root.has("reference")))
            throw InputError(root.place(entry.kind->name()),
                             entry.kind->name() +
                                 " measures errors against an exact solution; give a solution, and "
                                 "no [data] or [reference]");
    if (auto reference = root.table("reference"))
        scene.reference = read_reference(*reference, scene.measured_series());
    if (!scene.has_exact_solution() && !scene.reference && !scene.measures().empty())
        throw InputError(
            root.place(std::find_if(entries.begin(), entries.end(), measures)->kind->name()),
            "the norms ask for errors, but the scene has no exact solution; remove them, or give "
            "a solution or a block [reference]");
}

/// The part of the problem that a sentence of left_out is about: "contact: the scene has no stops".
std::string part_of(const std::string& sentence) {
    return sentence.substr(0, sentence.find(':'));
}

/// [expect.quadrature] and [expect.separation]: what is done to the problem before it is run.
void expect_preparation(TableReader& expect, const Scene& scene,
                        std::vector<Expectation>& expectations) {
    // figure: what it is, or the reason why there is none.
    const auto band = [&](TableReader& table, const std::string& key, auto figure) {
        expect_band(table, key, expectations,
                    [name = what_of(table, key), figure](const StudyResult& result) {
                        const auto [value, absence] = figure(result);
                        return std::vector{Metric{name, value, absence}};
                    });
    };
    using Figure = std::pair<std::optional<double>, std::string>;
    const auto read = [&](const std::string& name, auto keys) {
        auto table = expect.table(name);
        if (!table)
            return;
        if (scene.solver || !scene.poses_problem())
            throw expect.error(name, " is of a problem that the scene poses, and it poses none");
        const std::size_t before = expectations.size();
        keys(*table);
        finish_expecting(*table, before, expectations);
    };
    read("quadrature", [&](TableReader& table) {
        const auto of = [&](const std::string& key, auto value) {
            band(table, key, [value](const StudyResult& result) -> Figure {
                if (!result.quadrature)
                    return {std::nullopt, "not known beside a [defect]"};
                return {static_cast<double>((*result.quadrature).*value), ""};
            });
        };
        of("intervals", &QuadratureResult::intervals);
        of("finest", &QuadratureResult::finest);
    });
    read("separation", [&](TableReader& table) {
        band(table, "rank", [](const StudyResult& result) -> Figure {
            return {static_cast<double>(result.separation.rank), ""};
        });
        band(table, "residual", [](const StudyResult& result) -> Figure {
            const SeparationResult& separation = result.separation;
            if (separation.rank > 0)
                return {separation.residual, ""};
            return {std::nullopt,
                    "no products: " + (separation.reason.empty() ? "there is nothing to replace"
                                                                 : separation.reason)};
        });
    });
}

/// [expect]: what is left out, the reference, what is derived, what is refused, what tables and
/// equations of others show, what commands say, a table for each study.
void read_expectations(Scene& scene, TableReader expect, const Reading& reading) {
    expect_refused(expect, scene, reading, scene.expectations);
    expect_analysed(expect, scene, scene.expectations);
    expect_equations(expect, scene, scene.expectations);
    expect_commands(expect, reading.program, scene.expectations);
    expect_words(expect, "left_out", scene.expectations, [](const StudyResult& result) {
        std::vector<std::string> parts;
        for (const auto& sentence : result.left_out)
            parts.push_back(part_of(sentence));
        return parts;
    });
    expect_sentences(expect, "remarks", scene.expectations,
                     [](const StudyResult& result) { return result.remarks; });
    expect_band(expect, "law_distance", scene.expectations, [](const StudyResult& result) {
        const bool yields = !result.scene.solver && result.scene.beam.stops.epsilon > 0.0;
        return std::vector{Metric{"law_distance",
                                  yields ? std::optional(result.law_distance) : std::nullopt,
                                  "none: there are no stops that yield"}};
    });
    expect_preparation(expect, scene, scene.expectations);
    if (auto table = expect.table("reference")) {
        if (!scene.reference)
            throw expect.error("reference", " expects something of a block [reference], which the "
                                            "scene does not have");
        const std::size_t before = scene.expectations.size();
        expect_reference(*table, scene.expectations);
        finish_expecting(*table, before, scene.expectations);
    }
    if (auto table = expect.table("derive")) {
        const std::size_t before = scene.expectations.size();
        expect_derived(*table, scene, scene.expectations);
        finish_expecting(*table, before, scene.expectations);
    }
    for (const auto& kind : study_kinds()) {
        auto table = expect.table(kind->name());
        if (!table)
            continue;
        const std::any* block = scene.blocks.find(*kind);
        const auto series = block != nullptr ? kind->series(*block, {}) : std::vector<Series>();
        const bool measured =
            !kind->measures() || (!series.empty() && !series.front().measures.empty());
        if (block == nullptr || !measured)
            throw expect.error(kind->name(),
                               " expects something of a study that the scene does not run: it "
                               "has no block [" +
                                   kind->name() + "]" + (kind->measures() ? " with norms" : ""));
        const std::size_t before = scene.expectations.size();
        kind->expect(*table, *block, scene.expectations);
        finish_expecting(*table, before, scene.expectations);
    }
    // --set expect={} takes away what the file expects.
    if (expect.place().line > 0)
        finish_expecting(expect, 0, scene.expectations);
    expect.finish();
}

} // namespace

namespace {

void override_keys(TomlDocument& document, const std::vector<std::string>& assignments) {
    for (const auto& assignment : assignments) {
        override_key(document, assignment);
        require_known_keys(document, scene_keys());
    }
}

/// What a variant of the scene does without.
void take_away_expectations(TomlDocument& document) {
    document.table.erase("expect");
    for (const auto& kind : study_kinds())
        if (kind->judges_expectations())
            document.table.erase(kind->name());
}

} // namespace

Scene read_scene(const std::string& name_or_file, const std::vector<std::string>& overrides,
                 const Reading& reading) {
    const std::filesystem::path path = find_file(Shipped::scene, name_or_file);
    TomlDocument document = read_toml(path.string());
    require_scene(document);
    require_known_keys(document, scene_keys());
    // A key of the short form is given to it before it replaces any.
    std::vector<std::string> of_short;
    std::vector<std::string> others;
    for (const auto& assignment : overrides)
        (assignment.starts_with("short.") || assignment.starts_with("short=") ? of_short : others)
            .push_back(assignment);
    override_keys(document, of_short);
    const auto names_runs_in_short =
        reading.short_form ? naming_runs_in_short(document) : std::set<std::string>();
    if (reading.short_form)
        merge_block(document, "short");
    override_keys(document, others);
    if (reading.variant) {
        take_away_expectations(document);
        override_keys(document, *reading.variant);
    }
    document.asked = reading.asked;

    Scene scene;
    scene.file = path.string();
    scene.name = path.stem().string();
    scene.text = document.text;
    scene.overrides = overrides;
    TableReader root(document, document.table, "", &scene_keys().root());
    scene.title = root.text("title").value_or(scene.name);
    scene.is_long = root.flag("long").value_or(false);
    scene.is_gate = root.flag("gate").value_or(false);
    const auto kinds = kinds_in(root);
    // A file without any study is told so after its problem, which may be what is wrong with it.
    const bool brings_its_own =
        !kinds.empty() && std::none_of(kinds.begin(), kinds.end(),
                                       [](const StudyKind* kind) { return kind->poses_problem(); });
    if (root.has("solver")) {
        read_solver_of(scene, root, !reading.unrun);
        read_studies(scene, root);
        if (!reading.unrun)
            require_placeholders(*scene.solver, scene.series());
    } else {
        read_problem(scene, root, !brings_its_own, reading);
        if (reading.solution)
            scene.problem = parse_solution(*reading.solution, "solution");
        read_studies(scene, root);
        read_reference(scene, root);
        check_meshes(scene, root);
        check_until(scene, root);
    }
    for (auto& [kind, block] : scene.blocks.entries())
        if (Until* until = kind->until(block))
            until->adds = !names_runs_in_short.contains(kind->name());
    if (auto defect = root.table("defect")) {
        if (!scene.poses_problem())
            throw InputError(defect->place(), "the block [defect] adds to the scene's problem, and "
                                              "no study of the scene runs that; remove it");
        scene.defect = read_defect(*std::move(defect));
    }
    const auto judging = std::find_if(kinds.begin(), kinds.end(), [](const StudyKind* kind) {
        return kind->judges_expectations();
    });
    if (auto expect = root.table("expect");
        expect && (reading.expectations || reading.variant || judging != kinds.end()))
        read_expectations(scene, *std::move(expect), reading);
    if (judging != kinds.end() && scene.expectations.empty())
        throw InputError(root.place((*judging)->name()),
                         (*judging)->name() + " asks what the scene's expectations catch, and it "
                                              "has none; add a block [expect]");
    if (auto report = root.table("report"))
        scene.report = read_report(*std::move(report), reading.report_files);
    root.table("short"); // what it holds is read in the short form
    root.finish();
    if (scene.solver && !reading.unrun)
        note_contents(*scene.solver); // last, as they may be large
    scene.json = [table = std::make_shared<const toml::table>(std::move(document.table))] {
        return json_of(*table);
    };
    return scene;
}

ProblemData problem_of(const Scene& scene, double final_time) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr)
        return given_problem(std::get<GivenData>(scene.problem), scene.beam, final_time);
    if (solution->phases.empty())
        throw InputError({scene.file}, "the scene has no problem of its own; run it on one");
    return manufactured_problem({*solution, scene.beam, final_time});
}

ErrorConstants forecast_constants(const Scene& scene, double final_time) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr || solution->phases.empty())
        return {"the scene has no solution from a text", {}};
    if (!scene.mesh.is_uniform())
        return {"the meshes are not uniform", {}};
    const AdmissibleSolution admissible(*solution, scene.beam, final_time);
    return error_constants(expected_orders(admissible), admissible,
                           {{scene.scheme.time.name, scene.scheme.thermal_mass}})
        .front();
}

void require_runnable(const Scene& scene, const ProblemData& data) {
    if (scene.solver)
        throw InputError({scene.file}, "the scene has a block [solver], which brings its problem; "
                                       "run it without another");
    if (!data.exact && !scene.reference && !scene.measures().empty())
        throw InputError({scene.file},
                         "the norms ask for errors, but the problem has no exact solution; give it "
                         "one, or the scene a reference");
    for (const auto& series : scene.series())
        for (const auto& [elements, steps, dt] : series.rungs)
            if (elements < 1 || steps < 1 ||
                !(std::abs(static_cast<double>(steps) * dt - series.final_time) <=
                  1e-9 * series.final_time))
                throw InputError({scene.file}, "a run has " + std::to_string(elements) +
                                                   " elements and " + std::to_string(steps) +
                                                   " steps of " + message_text(dt) +
                                                   "; they must fill the final time " +
                                                   message_text(series.final_time));
}

bool Scene::poses_problem() const {
    return std::any_of(blocks.entries().begin(), blocks.entries().end(),
                       [](const ByKind::Entry& entry) { return entry.kind->poses_problem(); });
}

Method Scene::method() const {
    return solver ? method_of(*solver, solver->parameters) : method_of(scheme);
}

std::vector<Series> Scene::series() const {
    const Method own = method();
    std::vector<Series> all;
    for (const auto& [kind, block] : blocks.entries())
        for (auto& one : kind->series(block, own))
            all.push_back(std::move(one));
    return all;
}

std::vector<Series> Scene::measured_series() const {
    auto all = series();
    std::erase_if(all, [](const Series& one) { return one.measures.empty(); });
    return all;
}

std::vector<Measure> Scene::measures() const {
    std::vector<Measure> all;
    for (const auto& [kind, block] : blocks.entries())
        if (const auto own = kind->series(block, {}); !own.empty())
            all.insert(all.end(), own.front().measures.begin(), own.front().measures.end());
    return all;
}

std::vector<std::string> left_out(const StudyContext& context) {
    const Scene& scene = context.scene;
    const ProblemData& data = context.data;
    std::vector<std::string> parts;
    Needs needs{false, false, false};
    bool timed = false;
    for (const auto& [kind, block] : scene.blocks.entries()) {
        needs = needs.with(kind->needs(block, context));
        timed = timed || kind->timed();
    }
    const bool measured = !scene.measures().empty();
    const bool coupled = scene.beam.alpha != 0.0;
    // What is timed is the whole problem.
    const bool direct = scene.scheme.algorithm == Algorithm::direct && !timed;
    if (!coupled)
        parts.emplace_back("coupling: alpha = 0, heat and bending are two separate problems");
    if (direct && !coupled && !needs.temperature)
        parts.emplace_back("temperature: no norm or probe asks for it");
    if (direct && !coupled && !needs.deflection)
        parts.emplace_back("deflection: no norm or probe asks for it");
    if (!scene.beam.stops.exist())
        parts.emplace_back("contact: the scene has no stops");
    if (scene.beam.zeta == 0.0)
        parts.emplace_back("viscosity: zeta = 0");
    if (data.heat_source.is_zero())
        parts.emplace_back("heat source: zero");
    if (data.moment_load.is_zero())
        parts.emplace_back("moment load: zero");
    if (!measured)
        parts.emplace_back("error norms: none asked for");
    if (!measured && scene.reference)
        parts.emplace_back("reference run: no norm asks for it");
    return parts;
}

} // namespace tvbeam
