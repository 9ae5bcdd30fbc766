#pragma once

#include "core/problem.hpp"
#include "core/scheme.hpp"
#include "core/space/mesh.hpp"
#include "mms/forecast/error_constants.hpp"
#include "mms/given_problem.hpp"
#include "mms/solution.hpp"
#include "mms/text/asked_keys.hpp"
#include "studies/external/solver_block.hpp"
#include "studies/reference/reference_block.hpp"
#include "studies/scene/report_block.hpp"
#include "studies/study_kind.hpp"

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tvbeam {

/// What to run. A study runs if its block is there.
struct Scene {
    std::string file;
    std::string name;  ///< the file's name without .toml
    std::string title; ///< the name where the scene has none
    /// In place of the beam: then beam, mesh, problem and scheme mean nothing.
    std::optional<SolverBlock> solver;
    Beam beam;
    MeshFamily mesh;
    std::variant<Solution, GivenData> problem;
    Scheme scheme;
    ByKind blocks;                           ///< of the studies that it has
    std::optional<ReferenceBlock> reference; ///< then errors are measured against it
    std::vector<Expectation> expectations;   ///< empty unless they were asked for
    std::optional<GivenData> defect;         ///< that every run adds to the problem
    ReportBlock report;                      ///< what --out writes
    bool is_gate = false;                    ///< it is there for what the program says and refuses
    bool is_long = false;               ///< it may take as long as it does (predicted_work.hpp)
    std::string text;                   ///< the file as it stands, without overrides
    std::vector<std::string> overrides; ///< KEY=VALUE each, in their order
    std::function<std::string()> json;  ///< the scene with its overrides, as JSON

    [[nodiscard]] bool has_exact_solution() const {
        return std::holds_alternative<Solution>(problem);
    }
    /// The block of a study, e.g. get<LadderBlock>(); null where the scene has none.
    template <typename Block>
    [[nodiscard]] const Block* get() const {
        return blocks.get<Block>();
    }
    template <typename Block>
    [[nodiscard]] Block* get() {
        return blocks.get<Block>();
    }

    /// How the scene's own runs are made: by its scheme, or its solver.
    [[nodiscard]] Method method() const;

    /// All runs of the scene's own problem that its studies ask for; and those that are measured.
    [[nodiscard]] std::vector<Series> series() const;
    [[nodiscard]] std::vector<Series> measured_series() const;

    /// What is measured, study by study.
    [[nodiscard]] std::vector<Measure> measures() const;

    /// Whether a study runs the scene's own problem; [stress] brings its own.
    [[nodiscard]] bool poses_problem() const;

    /// To which a study of the scene's own problem runs; 0 without one.
    [[nodiscard]] double longest_time() const { return tvbeam::longest_time(series()); }
};

/// How a scene is read.
struct Reading {
    bool short_form = false; ///< with the block [short], whose keys replace those of the same path
    bool expectations = false; ///< with the block [expect]; otherwise it is passed over
    bool own_problem = false;  ///< without solution and [data]: the caller has the problem
    bool unrun = false;        ///< for what it says of itself alone: without its solution, and
                               ///< without formulas in templates
    /// Kinds of files that [report] may name; empty: any.
    std::vector<std::string> report_files = {};
    std::string program = {};   ///< tvbeam's own file, which [[expect.commands]] run; empty: none
    AskedKeys* asked = nullptr; ///< where to note what the scene may hold and does; null: nowhere
    /// With these keys, KEY=VALUE each, and without what the scene itself expects and what studies
    /// that: as [[expect.refused]] changes it. Expectations are read where a key is of them.
    std::optional<std::vector<std::string>> variant = std::nullopt;
    /// The text of a solution in place of the scene's.
    std::optional<std::string> solution = std::nullopt;
};

/// Reads a scene: a shipped name or a file, with overrides `key=value` applied in order. Everything
/// that can be said without running is checked here. Throws InputError at file:line:column.
Scene read_scene(const std::string& name_or_file, const std::vector<std::string>& overrides = {},
                 const Reading& reading = {});

/// The problem of a scene up to final_time; throws InputError where its solution or data are not
/// admissible.
ProblemData problem_of(const Scene& scene, double final_time);

/// The sizes of the leading errors of the scene's own scheme, up to final_time; not known without a
/// solution from a text, and on meshes that are not uniform.
ErrorConstants forecast_constants(const Scene& scene, double final_time);

/// Refuses, for a scene that is run on a problem of the caller's, what a reader would have refused:
/// throws InputError where norms ask for errors and there is no exact solution, and where the steps
/// of a run do not fill its final time.
void require_runnable(const Scene& scene, const ProblemData& data);

/// What the scene does without, in words, e.g. "contact: the scene has no stops". The problem of
/// the context is the one that is measured.
std::vector<std::string> left_out(const StudyContext& context);

} // namespace tvbeam
