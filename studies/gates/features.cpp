#include "studies/gates/features.hpp"

#include "core/norms/norms.hpp"
#include "mms/expression/algebra.hpp"
#include "mms/expression/expression_parser.hpp"
#include "mms/sample_points.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/grid/orders_block.hpp"
#include "studies/ladder/ladder_block.hpp"
#include "studies/runs/beam_runs.hpp"
#include "studies/scene/scene_keys.hpp"
#include "studies/study.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace tvbeam {

namespace {

/// Keys that change no number of a result.
const std::vector<FeatureTable::Exception> known_exceptions{
    {"key title", "what the scene is called"},
    {"key long", "that it may take long"},
    {"key short", "its keys are those of the scene itself"},
    {"key report", "what --out writes"},
    {"key report.files", "what --out writes"},
    {"key ladder.printed.source", "what a column is called"},
    {"key work_precision.runs", "how often a run is timed"},
    {"key work_precision.targets", "errors whose times are compared"},
    {"key work_precision.targets.NORM", "errors whose times are compared"},
    {"key solver.timeout", "how long a run may take: tests/external"},
    {"key stress.sweep.NAME.work", "how many steps a case may have: tests/studies/stress.cpp"},
};

/// beam.theta_A: beam, theta_A.
std::vector<std::string> words_of(const std::string& path) {
    std::vector<std::string> words;
    std::istringstream stream(path);
    for (std::string word; std::getline(stream, word, '.');)
        words.push_back(word);
    return words;
}

/// The name of a key in the table of keys. [stress.contraction] and [stress.roundoff] have one
/// reader of scheme and mass.
std::string feature_of(const std::string& entry) {
    for (const std::string key : {"time", "thermal_mass"})
        if (entry == "stress.contraction." + key || entry == "stress.roundoff." + key)
            return "key stress.NAME." + key;
    return "key " + entry;
}

/// What a scene has, by the names of features; the others with false.
using Uses = std::map<std::string, bool>;

void add_keys(const AskedKeys& asked, Uses& uses) {
    for (const auto& entry : scene_keys().entries()) {
        uses[feature_of(entry.path)] |= false;
        if (entry.type == KeyType::choice)
            for (const auto& word : entry.words)
                uses[fmt::format("{} = {}", feature_of(entry.path), word)] |= false;
    }
    for (const auto& [path, key] : asked) {
        const std::string name = feature_of(key.entry);
        uses[name] |= key.given;
        if (!key.chosen.empty())
            uses[fmt::format("{} = {}", name, key.chosen)] = true;
    }
}

/// The texts of the scene's problem.
std::vector<SourceText> texts_of(const Scene& scene) {
    std::vector<SourceText> texts;
    const auto add = [&](const std::optional<SourceText>& text) {
        if (text)
            texts.push_back(*text);
    };
    if (scene.solver)
        return texts;
    if (const auto* data = std::get_if<GivenData>(&scene.problem))
        for (const auto& text : {data->theta0, data->u0, data->heat_source, data->body_force})
            add(text);
    else
        for (const auto& phase : std::get<Solution>(scene.problem).phases) {
            for (const auto& text : {phase.theta, phase.u})
                add(text);
            add(phase.sigma);
        }
    return texts;
}

void add_functions(const Scene& scene, Uses& uses) {
    const auto texts = scene.poses_problem() ? texts_of(scene) : std::vector<SourceText>();
    const auto add = [&](const std::string& name, const auto& uses_it) {
        uses["formula " + name] |= std::any_of(texts.begin(), texts.end(), uses_it);
    };
    for (const auto& function : function_names())
        add(function,
            [&](const SourceText& text) { return first_use(text, function).has_value(); });
    // What algebra treats apart: powers by repeated squaring, and the functions of a sum that
    // separation takes to pieces.
    const std::regex high_power("\\^[5-9]");
    add("x^n, n > 4",
        [&](const SourceText& text) { return std::regex_search(text.text(), high_power); });
    for (const std::string function : {"exp", "sin", "cos", "sinh", "cosh"}) {
        const std::regex of_sum("\\b" + function + R"(\(x [+-] t\))");
        add(function + "(x + t)",
            [&](const SourceText& text) { return std::regex_search(text.text(), of_sum); });
    }
}

/// Norms and probes whose figures the scene expects, of its runs.
void add_measures(const Scene& scene, const AskedKeys& asked, Uses& uses) {
    std::set<std::string> expected; // words of the paths in [expect]
    for (const auto& [path, key] : asked)
        if (key.given && path.starts_with("expect.") && !path.starts_with("expect.derive.")) {
            const auto words = words_of(path);
            expected.insert(words.begin(), words.end());
        }
    for (const auto& norm : Norm::names()) {
        uses["norm " + norm] |= expected.contains(norm);
        uses["norm squared"] |= expected.contains(norm + "_sq");
    }
    const auto* evolution = scene.get<EvolutionBlock>();
    for (const std::string quantity : {"temperature", "deflection"})
        for (const std::string place : {"at a node", "between nodes"})
            uses[fmt::format("probe of {} {}", quantity, place)] |= false;
    for (const std::string other : {"tip", "contact stress", "energy"})
        uses["probe of " + other] |= false;
    if (evolution == nullptr)
        return;
    const auto nodes = scene.mesh.with(evolution->rung.elements).nodes;
    for (const auto& [name, probe] : evolution->probes) {
        const bool gated =
            std::any_of(asked.begin(), asked.end(),
                        [&, start = "expect.evolution." + name + "."](const auto& one) {
                            return one.second.given && one.first.starts_with(start);
                        });
        const std::string place =
            (nodes - probe.x).abs().minCoeff() < 1e-12 ? " at a node" : " between nodes";
        switch (probe.quantity) {
        case Probe::Quantity::temperature:
            uses["probe of temperature" + place] |= gated;
            break;
        case Probe::Quantity::deflection:
            uses[probe.x == 1.0 ? "probe of tip" : "probe of deflection" + place] |= gated;
            break;
        case Probe::Quantity::stress:
            uses["probe of contact stress"] |= gated;
            break;
        case Probe::Quantity::energy:
            uses["probe of energy"] |= gated;
            break;
        }
    }
}

/// A run of a scene, and what it is a run of.
struct Setting {
    const Scene& scene;
    const ProblemData& data;
    const Scheme& scheme;
    const RungResult& run;
};

/// What runs consist of.
struct Factor {
    std::string name;
    std::vector<std::string> levels;
    /// Of a run; none: this factor says nothing of it.
    std::function<std::optional<std::size_t>(const Setting&)> level;

    [[nodiscard]] std::string level_name(std::size_t i) const { return name + " " + levels[i]; }
};

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::size_t contact_level(const Setting& setting) {
    const Stops& stops = setting.scene.beam.stops;
    if (!stops.exist())
        return 0;
    if (setting.run.count("contact_steps") == 0)
        return 1;
    const bool both = std::isfinite(stops.lower) && std::isfinite(stops.upper);
    return stops.epsilon > 0.0 ? 4 : both ? 2 : 3;
}

/// Polynomials of a degree below 8 have no eighth divided difference. Times k! and the mean
/// distance to the power k it is the kth difference where points are equally distant.
bool is_polynomial(const Eigen::ArrayXd& x, const Eigen::ArrayXd& values) {
    const auto mean_distance = (x(x.size() - 1) - x(0)) / static_cast<double>(x.size() - 1);
    Eigen::ArrayXd differences = values;
    for (Eigen::Index k = 1; k <= 8; ++k) {
        const Eigen::Index left = differences.size() - 1;
        const Eigen::ArrayXd apart = (x.tail(left) - x.head(left)) / mean_distance;
        differences =
            (static_cast<double>(k) * (differences.tail(left) - differences.head(left)) / apart)
                .eval();
    }
    return differences.abs().maxCoeff() <= 1e-10 * values.abs().maxCoeff();
}

std::size_t body_force_level(const Setting& setting) {
    if (setting.data.body_force.is_zero())
        return 0;
    const Eigen::ArrayXd x = sample_points(0.0, 1.0, 11);
    const double t = setting.scene.longest_time() / std::sqrt(2.0);
    return is_polynomial(x, values(setting.data, setting.data.body_force, x, t)) ? 1 : 2;
}

const std::vector<Factor>& factors() {
    static const std::vector<Factor> all{
        {"time", TimeScheme::names(),
         [](const Setting& of) { return place_in(TimeScheme::names(), of.scheme.time.name); }},
        {"thermal mass",
         {name_of(ThermalMass::consistent), name_of(ThermalMass::lumped)},
         [](const Setting& of) { return of.scheme.thermal_mass == ThermalMass::lumped ? 1U : 0U; }},
        {"mesh",
         {"uniform", "graded", "of listed nodes"},
         [](const Setting& of) {
             const MeshFamily& mesh = of.scene.mesh;
             return mesh.is_uniform() ? 0U : mesh.nodes.empty() ? 1U : 2U;
         }},
        {"contact",
         {"without stops", "not touched", "with two stops", "with one stop", "by penalty"},
         contact_level},
        {"march",
         {"in sines", "in nodal values", "by the fixed point"},
         [](const Setting& of) {
             return of.scheme.algorithm == Algorithm::fixed_point ? 2U
                    : of.run.count("sine_steps") > 0              ? 0U
                                                                  : 1U;
         }},
        {"theta_A",
         {"zero", "not zero"},
         [](const Setting& of) { return of.scene.beam.theta_A == 0.0 ? 0U : 1U; }},
        {"source",
         {"of products", "that does not separate"},
         [](const Setting& of) {
             return of.data.heat_source.is_separable() && of.data.moment_load.is_separable() ? 0U
                                                                                             : 1U;
         }},
        {"zeta",
         {"zero", "not zero"},
         [](const Setting& of) { return of.scene.beam.zeta == 0.0 ? 0U : 1U; }},
        {"alpha",
         {"zero", "not zero"},
         [](const Setting& of) { return of.scene.beam.alpha == 0.0 ? 0U : 1U; }},
        {"body force", {"zero", "polynomial in x", "no polynomial in x"}, body_force_level},
        {"problem",
         {"of a solution", "given as data"},
         [](const Setting& of) { return of.scene.has_exact_solution() ? 0U : 1U; }},
        {"errors against",
         {"a solution", "a reference", "an extrapolated reference"},
         [](const Setting& of) -> std::optional<std::size_t> {
             if (of.scene.reference && !of.run.errors.empty())
                 return of.scene.reference->richardson ? 2U : 1U;
             return of.data.exact ? std::optional<std::size_t>(0U) : std::nullopt;
         }},
    };
    return all;
}

/// Pairs that no run can have.
struct Impossible {
    std::string first;
    std::string second;
    std::string reason;
};

const std::vector<Impossible> impossible{
    {"mesh graded", "march in sines", "the sine basis wants a uniform mesh"},
    {"mesh of listed nodes", "march in sines", "the sine basis wants a uniform mesh"},
    {"march in sines", "errors against a reference", "a reference is no sum of products"},
    {"march in sines", "errors against an extrapolated reference",
     "a reference is no sum of products"},
    {"march in sines", "problem given as data", "its errors are those against a reference"},
    {"problem given as data", "errors against a solution", "there is none"},
    {"mesh graded", "errors against a reference", "a reference wants uniform meshes"},
    {"mesh of listed nodes", "errors against a reference", "a reference wants uniform meshes"},
    {"mesh graded", "errors against an extrapolated reference", "a reference wants uniform meshes"},
    {"mesh of listed nodes", "errors against an extrapolated reference",
     "a reference wants uniform meshes"},
};

const Impossible* impossible_pair(const std::string& first, const std::string& second) {
    const auto found = std::find_if(impossible.begin(), impossible.end(), [&](const auto& one) {
        return one.first == first && one.second == second;
    });
    return found == impossible.end() ? nullptr : &*found;
}

std::string pair_name(const std::string& first, const std::string& second) {
    return first + ", " + second;
}

/// Calls visit(one, other) with the names of every pair of levels of different factors.
template <typename Visit>
void for_each_pair(const Visit& visit) {
    const auto& all = factors();
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
            for (std::size_t i = 0; i < all[a].levels.size(); ++i)
                for (std::size_t j = 0; j < all[b].levels.size(); ++j)
                    visit(all[a].level_name(i), all[b].level_name(j));
}

void add_setting(const Setting& setting, Uses& uses, Uses& pairs) {
    std::vector<std::string> levels;
    for (const auto& factor : factors())
        if (const auto level = factor.level(setting))
            levels.push_back(factor.level_name(*level));
    for (std::size_t i = 0; i < levels.size(); ++i) {
        uses[levels[i]] = true;
        for (std::size_t j = i + 1; j < levels.size(); ++j)
            pairs[pair_name(levels[i], levels[j])] = true;
    }
}

/// The first level of every ladder and grid: of what a run consists, the others have as well.
Scene shortest_form(Scene scene) {
    if (auto* ladder = scene.get<LadderBlock>()) {
        ladder->rungs.resize(1);
        ladder->until.reset();
    }
    if (auto* orders = scene.get<OrdersBlock>()) {
        orders->grid.resize(1);
        orders->until.reset();
    }
    if (auto* race = scene.get<WorkPrecisionBlock>()) {
        race->runs = 1;
        for (auto& scheme : race->schemes)
            scheme.rungs.resize(1);
    }
    // What the whole scene is expected to show is not to be judged by this.
    std::erase_if(scene.blocks.entries(),
                  [](const ByKind::Entry& entry) { return entry.kind->judges_expectations(); });
    return scene;
}

/// What the runs of the studies that the scene expects something of consist of.
void add_runs(const Scene& scene, const AskedKeys& asked, Uses& uses, Uses& pairs) {
    const Scene first = shortest_form(scene);
    const ProblemData data = problem_of(first, first.longest_time());
    const StudyResult result = run_study(first, data);
    uses["source by products to round-off"] |= result.separation.rank > 0;
    uses["source at every point of the direct algorithm"] |= !result.separation.reason.empty();
    const auto is_gated = [&](const std::string& study) {
        const auto key = asked.find("expect." + study.substr(0, study.find('.')));
        return key != asked.end() && key->second.given;
    };
    for (const auto& [series, runs] : result.runs())
        if (is_gated(series.study))
            add_setting({first, data, scheme_of(series.method), runs->front()}, uses, pairs);
    if (const auto* evolution = result.get<EvolutionResult>();
        evolution != nullptr && is_gated("evolution"))
        add_setting({first, data, first.scheme, evolution->run}, uses, pairs);
}

using Scenes = std::map<std::string, std::vector<std::string>>;

void note(const Uses& uses, const std::string& scene, Scenes& scenes) {
    for (const auto& [name, used] : uses) {
        auto& users = scenes[name];
        if (used)
            users.push_back(scene);
    }
}

std::vector<Feature> listed(const Scenes& scenes) {
    std::vector<Feature> features;
    for (const auto& [name, users] : scenes)
        features.push_back({name, users});
    return features;
}

} // namespace

FeatureTable feature_table(const std::vector<ShippedFile>& files) {
    Scenes features;
    Scenes pairs;
    FeatureTable table{.features = {}, .pairs = {}, .exceptions = known_exceptions};
    for (const auto& factor : factors())
        for (std::size_t i = 0; i < factor.levels.size(); ++i)
            features[factor.level_name(i)];
    for_each_pair([&](const std::string& first, const std::string& second) {
        if (const auto* never = impossible_pair(first, second))
            table.exceptions.push_back({pair_name(first, second), never->reason});
        else
            pairs[pair_name(first, second)];
    });
    for (const auto& file : files) {
        AskedKeys asked;
        const Scene scene = read_scene(file.path.string(), {},
                                       {.short_form = true, .expectations = true, .asked = &asked});
        Uses uses;
        Uses used_pairs;
        add_keys(asked, uses);
        add_functions(scene, uses);
        add_measures(scene, asked, uses);
        if (!scene.expectations.empty() && scene.poses_problem() && !scene.solver)
            add_runs(scene, asked, uses, used_pairs);
        if (scene.expectations.empty())
            for (auto& [name, used] : uses)
                used = false;
        note(uses, scene.name, features);
        note(used_pairs, scene.name, pairs);
    }
    for (const auto& exception : known_exceptions)
        features.erase(exception.name);
    table.features = listed(features);
    table.pairs = listed(pairs);
    return table;
}

} // namespace tvbeam
