#include "studies/scene/scene.hpp"

#include "core/norms/error_norms.hpp"
#include "mms/manufactured_problem.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/scene/model_keys.hpp"
#include "studies/scene/scheme_keys.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/scene/toml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace tvbeam {

namespace {

/// Figures may stand there for norms that are not asked for, e.g. after --set ladder.norms=…
PrintedFigures read_printed(TableReader table, const LadderBlock& ladder) {
    PrintedFigures printed;
    printed.source = table.text("source").value_or("printed");
    for (const auto& root : Norm::names())
        for (const auto& name : {root, root + "_sq"}) {
            if (!Norm::named(name))
                continue;
            const auto figures = table.numbers(name);
            if (!figures)
                continue;
            if (figures->size() != ladder.rungs.size())
                throw InputError(table.place(name),
                                 table.full(name) + " has " + std::to_string(figures->size()) +
                                     " figures for " + std::to_string(ladder.rungs.size()) +
                                     " rungs; give one a rung, or none: --set " +
                                     table.full("").substr(0, table.full("").size() - 1) + "={}");
            if (std::any_of(ladder.norms.begin(), ladder.norms.end(),
                            [&](const Norm& norm) { return norm.name == name; }))
                printed.figures[name] = *figures;
        }
    table.finish();
    return printed;
}

Scheme read_scheme(TableReader table) {
    Scheme scheme = read_scheme_keys(table, {});
    table.finish();
    return scheme;
}

LadderBlock read_ladder(TableReader table) {
    LadderBlock ladder;
    ladder.final_time = read_final_time(table);
    ladder.rungs = read_rungs(table, ladder.final_time);
    ladder.norms = read_norms(table);
    if (auto printed = table.table("printed"))
        ladder.printed = read_printed(*std::move(printed), ladder);
    table.finish();
    return ladder;
}

OrdersBlock read_orders(TableReader table) {
    OrdersBlock orders;
    orders.final_time = read_final_time(table);
    const auto elements = read_elements(table);
    const auto dt = table.numbers("dt");
    if (!dt || dt->empty())
        throw InputError(table.place("dt"),
                         table.full("dt") + " is missing or empty; give the steps that every mesh "
                                            "is run with, e.g. [1e-2, 5e-3, 2.5e-3]");
    for (std::size_t j = 0; j < dt->size(); ++j)
        for (const std::int64_t s : elements)
            orders.grid.push_back({s, steps_of(table, j, orders.final_time, (*dt)[j]), (*dt)[j]});
    orders.norms = read_norms(table);
    if (orders.norms.empty())
        throw InputError(table.place("norms"),
                         table.full("norms") +
                             " is missing or empty; name the norms whose orders are wanted");
    for (std::size_t i = 0; i < orders.norms.size(); ++i)
        if (orders.norms[i].name != orders.norms[i].root())
            throw InputError(table.place("norms", i),
                             table.full("norms") + " names the square '" + orders.norms[i].name +
                                 "'; the model is one of the norm itself: write " +
                                 orders.norms[i].root());
    table.finish();
    return orders;
}

GivenData read_data(TableReader table) {
    GivenData data;
    data.theta0 = table.expression("theta0");
    data.u0 = table.expression("u0");
    data.heat_source = table.expression("heat_source");
    data.body_force = table.expression("body_force");
    table.finish();
    return data;
}

Solution read_scene_solution(TableReader& root, const std::filesystem::path& beside) {
    return read_solution(
        find_file(Shipped::solution, *root.text("solution"), beside, root.place("solution")));
}

/// The shortest element against the longest, below which a mesh is refused: half the digits.
constexpr double least_ratio = 1e-8;

/// Meshes that the studies of the scene cannot have.
void check_meshes(const Scene& scene, const TableReader& root) {
    if (scene.reference && !scene.mesh.is_uniform())
        throw InputError(root.place("mesh"),
                         "a block [reference] wants uniform meshes, whose nodes are all nodes of "
                         "the reference; remove the block [mesh]");
    const auto intervals = static_cast<std::int64_t>(scene.mesh.nodes.size()) - 1;
    const auto check = [&](const std::vector<Rung>& rungs) {
        for (const Rung& rung : rungs) {
            if (intervals > 0 && rung.elements % intervals != 0)
                throw InputError(root.place("mesh"),
                                 "mesh.nodes has " + std::to_string(intervals) +
                                     " intervals, and a run has " + std::to_string(rung.elements) +
                                     " elements; every interval must get the same number");
            if (scene.mesh.is_uniform())
                continue;
            const auto lengths = scene.mesh.with(rung.elements).lengths;
            if (!(lengths.minCoeff() >= least_ratio * lengths.maxCoeff()))
                throw InputError(root.place("mesh"),
                                 "with " + std::to_string(rung.elements) +
                                     " elements the shortest is " +
                                     message_text(lengths.minCoeff()) + " and the longest " +
                                     message_text(lengths.maxCoeff()) +
                                     "; they must be within a factor of 1e8: grade less");
        }
    };
    if (scene.ladder)
        check(scene.ladder->rungs);
    if (scene.orders)
        check(scene.orders->grid);
    if (scene.work_precision)
        for (const auto& scheme : scene.work_precision->schemes)
            check(scheme.rungs);
    if (scene.evolution)
        check({scene.evolution->rung});
}

/// The studies whose records have figures of their own for [expect].
std::vector<std::string> figured_studies(const Scene& scene) {
    std::vector<std::string> studies;
    if (scene.evolution)
        studies.emplace_back("evolution");
    if (scene.stress)
        studies.emplace_back("stress");
    return studies;
}

std::string json_of(const toml::table& table) {
    std::ostringstream text;
    text << toml::json_formatter{table, toml::format_flags::quote_infinities_and_nans};
    return text.str();
}

} // namespace

double Scene::longest_time() const {
    return std::max({ladder ? ladder->final_time : 0.0, orders ? orders->final_time : 0.0,
                     work_precision ? work_precision->final_time : 0.0,
                     evolution ? evolution->final_time : 0.0});
}

Scene read_scene(const std::string& name_or_file, const std::vector<std::string>& overrides,
                 const Reading& reading) {
    const std::filesystem::path path = find_file(Shipped::scene, name_or_file);
    TomlDocument document = read_toml(path.string());
    if (reading.short_form)
        merge_block(document, "short");
    for (const auto& assignment : overrides)
        override_key(document, assignment);

    Scene scene;
    scene.file = path.string();
    scene.name = path.stem().string();
    scene.text = document.text;
    scene.overrides = overrides;
    scene.json = json_of(document.table);
    TableReader root(document, document.table, "");
    scene.title = root.text("title").value_or(scene.name);

    if (auto stress = root.table("stress"))
        scene.stress = read_stress(*std::move(stress));
    const bool stress_only = scene.stress && !root.has("ladder") && !root.has("orders") &&
                             !root.has("work_precision") && !root.has("evolution");

    auto beam = root.table("beam");
    if (!beam && !stress_only)
        throw InputError({scene.file},
                         root.has("theta") || root.has("u") || root.has("phase")
                             ? "is a solution, not a scene; a scene names it: solution = \"./" +
                                   path.filename().string() + "\" (tvbeam new writes both)"
                             : "the block [beam] is missing; it holds alpha, zeta and the stops");
    if (beam)
        scene.beam = read_beam(*std::move(beam));
    if (auto mesh = root.table("mesh"))
        scene.mesh = read_mesh(*std::move(mesh));
    if (auto scheme = root.table("scheme"))
        scene.scheme = read_scheme(*std::move(scheme));

    auto data = root.table("data");
    if (reading.own_problem && (data || root.has("solution")))
        throw InputError(root.place(data ? "data" : "solution"),
                         "the program that reads the scene brings its problem with it; remove the "
                         "scene's");
    if (!stress_only && !reading.own_problem && root.has("solution") == data.has_value())
        throw InputError(
            root.place(data ? "data" : "solution"),
            data ? "the scene has both a solution and a [data] block; remove one"
                 : "the scene has neither a solution nor a [data] block; give one of them");
    if (data)
        scene.problem = read_data(*std::move(data));
    else if (root.has("solution"))
        scene.problem = read_scene_solution(root, path.parent_path());

    if (auto ladder = root.table("ladder"))
        scene.ladder = read_ladder(*std::move(ladder));
    if (auto orders = root.table("orders"))
        scene.orders = read_orders(*std::move(orders));
    if (auto timed = root.table("work_precision"))
        scene.work_precision = read_work_precision(*std::move(timed), scene.scheme);
    if (auto evolution = root.table("evolution"))
        scene.evolution = read_evolution(*std::move(evolution));
    if (!scene.poses_problem() && !scene.stress)
        throw InputError({scene.file}, "the scene has no study; add a block [ladder], [orders], "
                                       "[work_precision], [evolution] or [stress]");
    if (root.has("reference") && !scene.ladder && !scene.orders && !scene.work_precision)
        throw InputError(root.place("reference"),
                         "the errors of a [ladder] or of [orders] are measured against a "
                         "reference, and the scene has neither; add one, or remove the block");
    if (auto reference = root.table("reference"))
        scene.reference =
            read_reference(*std::move(reference), scene.ladder ? &*scene.ladder : nullptr,
                           scene.orders ? &*scene.orders : nullptr);
    if (scene.work_precision && (!scene.has_exact_solution() || scene.reference))
        throw InputError(root.place("work_precision"),
                         "work_precision measures errors against an exact solution; give a "
                         "solution, and no [data] or [reference]");
    if (!scene.has_exact_solution() && !scene.reference && !scene.norms().empty())
        throw InputError(
            root.place(scene.orders ? "orders" : "ladder"),
            "the norms ask for errors, but the scene has no exact solution; remove them, or give "
            "a solution or a block [reference]");
    check_meshes(scene, root);
    if (auto expect = root.table("expect"); expect && reading.expectations)
        scene.expectations = read_expectations(
            *std::move(expect), scene.ladder ? &*scene.ladder : nullptr,
            scene.orders ? &*scene.orders : nullptr,
            scene.work_precision ? &*scene.work_precision : nullptr, figured_studies(scene));
    if (auto report = root.table("report"))
        scene.report = read_report(*std::move(report));
    root.table("short"); // what it holds is read in the short form
    root.finish();
    return scene;
}

ProblemData problem_of(const Scene& scene, double final_time) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr)
        return given_problem(std::get<GivenData>(scene.problem), scene.beam, final_time);
    if (solution->phases.empty())
        throw InputError({scene.file}, "the scene has no problem of its own; run it on one");
    return manufactured_problem(*solution, scene.beam, final_time);
}

void require_runnable(const Scene& scene, const ProblemData& data) {
    if (!data.exact && !scene.reference && !scene.norms().empty())
        throw InputError({scene.file},
                         "the norms ask for errors, but the problem has no exact solution; give it "
                         "one, or the scene a reference");
    const auto require_filled = [&](double final_time, const std::vector<Rung>& rungs) {
        for (const auto& [elements, steps, dt] : rungs)
            if (elements < 1 || steps < 1 ||
                !(std::abs(static_cast<double>(steps) * dt - final_time) <= 1e-9 * dt))
                throw InputError({scene.file},
                                 "a run has " + std::to_string(elements) + " elements and " +
                                     std::to_string(steps) + " steps of " + message_text(dt) +
                                     "; they must fill the final time " + message_text(final_time));
    };
    if (scene.ladder)
        require_filled(scene.ladder->final_time, scene.ladder->rungs);
    if (scene.orders)
        require_filled(scene.orders->final_time, scene.orders->grid);
}

std::vector<Norm> Scene::norms() const {
    std::vector<Norm> all;
    const auto add = [&](const std::vector<Norm>& norms) {
        all.insert(all.end(), norms.begin(), norms.end());
    };
    if (ladder)
        add(ladder->norms);
    if (orders)
        add(orders->norms);
    if (work_precision)
        add(work_precision->norms);
    return all;
}

std::vector<std::string> left_out(const Scene& scene, const ProblemData& data) {
    std::vector<std::string> parts;
    const std::vector<Norm> norms = scene.norms();
    Needs needs = ErrorNorms::needs(data, norms);
    if (scene.evolution) {
        const Needs probes = needs_of(*scene.evolution, scene.beam.stops);
        // A ladder without norms runs the whole problem.
        needs = norms.empty() && !scene.ladder ? probes : needs.with(probes);
    }
    const bool coupled = scene.beam.alpha != 0.0;
    // What is timed is the whole problem.
    const bool direct = scene.scheme.algorithm == Algorithm::direct && !scene.work_precision;
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
    if (norms.empty())
        parts.emplace_back("error norms: none asked for");
    if (norms.empty() && scene.reference)
        parts.emplace_back("reference run: no norm asks for it");
    return parts;
}

} // namespace tvbeam
