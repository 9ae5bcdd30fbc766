#pragma once

#include "core/norms/norms.hpp"
#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/space/mesh.hpp"
#include "mms/given_problem.hpp"
#include "mms/solution.hpp"
#include "studies/evolution/evolution_block.hpp"
#include "studies/gates/expectation.hpp"
#include "studies/reference/reference_block.hpp"
#include "studies/scene/report_block.hpp"
#include "studies/scene/study_keys.hpp"
#include "studies/stress/stress_block.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tvbeam {

/// Figures to compare with, a list of one figure a rung for each norm.
struct PrintedFigures {
    std::string source; ///< where they were printed
    std::map<std::string, std::vector<double>> figures;
};

/// The block [ladder]: the same problem on a sequence of meshes and steps.
struct LadderBlock {
    double final_time = 0.0;
    std::vector<Rung> rungs;
    std::vector<Norm> norms;
    std::optional<PrintedFigures> printed;
};

/// The block [orders]: a grid of runs, every mesh with every step.
struct OrdersBlock {
    double final_time = 0.0;
    std::vector<Rung> grid;  ///< elements change fastest
    std::vector<Norm> norms; ///< none is a square, but for `corollary`
};

/// What to run. A study runs if its block is there.
struct Scene {
    std::string file;
    std::string name;  ///< the file's name without .toml
    std::string title; ///< the name where the scene has none
    Beam beam;
    MeshFamily mesh;
    std::variant<Solution, GivenData> problem;
    Scheme scheme;
    std::optional<LadderBlock> ladder;
    std::optional<OrdersBlock> orders;
    std::optional<WorkPrecisionBlock> work_precision;
    std::optional<EvolutionBlock> evolution;
    std::optional<StressBlock> stress;       ///< brings its own beams, schemes and problems
    std::optional<ReferenceBlock> reference; ///< then errors are measured against it
    std::vector<Expectation> expectations;   ///< empty unless they were asked for
    ReportBlock report;                      ///< what --out writes
    std::string text;                        ///< the file as it stands, without overrides
    std::vector<std::string> overrides;      ///< KEY=VALUE each, in their order
    std::string json;                        ///< the scene with its overrides, as JSON

    [[nodiscard]] bool has_exact_solution() const {
        return std::holds_alternative<Solution>(problem);
    }
    /// Of all studies that want errors; a study's own squares included.
    [[nodiscard]] std::vector<Norm> norms() const;

    /// Whether a study runs the scene's own problem; [stress] brings its own.
    [[nodiscard]] bool poses_problem() const {
        return ladder || orders || work_precision || evolution;
    }

    /// To which a study of the scene's own problem runs; 0 without one.
    [[nodiscard]] double longest_time() const;
};

/// How a scene is read.
struct Reading {
    bool short_form = false; ///< with the block [short], whose keys replace those of the same path
    bool expectations = false; ///< with the block [expect]; otherwise it is passed over
    bool own_problem = false;  ///< without solution and [data]: the caller has the problem
};

/// Reads a scene: a shipped name or a file, with overrides `key=value` applied in order. Everything
/// that can be said without running is checked here. Throws InputError at file:line:column.
Scene read_scene(const std::string& name_or_file, const std::vector<std::string>& overrides = {},
                 const Reading& reading = {});

/// The problem of a scene up to final_time; throws InputError where its solution or data are not
/// admissible.
ProblemData problem_of(const Scene& scene, double final_time);

/// Refuses, for a scene that is run on a problem of the caller's, what a reader would have refused:
/// throws InputError where norms ask for errors and there is no exact solution, and where the steps
/// of a rung do not fill the final time.
void require_runnable(const Scene& scene, const ProblemData& data);

/// What the scene does without, in words, e.g. "contact: the scene has no stops".
std::vector<std::string> left_out(const Scene& scene, const ProblemData& data);

} // namespace tvbeam
