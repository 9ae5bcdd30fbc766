#pragma once

#include "studies/external/figure_source.hpp"
#include "studies/external/placeholders.hpp"
#include "studies/scene/study_keys.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A file in the directory of each run.
struct SolverFile {
    std::filesystem::path source;
    std::string name;                 ///< in the directory
    std::optional<Template> contents; ///< of a template, to be filled in; others are copied
    std::string digest = {};          ///< of what others held at note_contents()
};

/// Parameters by name, as they are written into commands and templates.
using Parameters = std::map<std::string, std::string>;

/// The block [solver]: a program that nobody here wrote.
struct SolverBlock {
    std::filesystem::path folder; ///< of the scene
    std::vector<Template> command;
    std::vector<SolverFile> files;
    FigureSource errors;
    FigureSource values;
    std::optional<OutputPattern> seconds; ///< the solver's own clock
    std::optional<double> timeout;        ///< s
    std::map<std::string, std::string> environment;
    Parameters parameters;
    std::map<std::string, double> of_solution; ///< the parameters of the file of equations

    [[nodiscard]] const FigureSource& source_of(const Measure& measure) const {
        return measure.is_value ? values : errors;
    }
};

/// Reads the block, and its templates:
///
///     command      a list: the program and its arguments, with placeholders (Template)
///     files        copied to the directory of each run; NAME.in is filled in and becomes NAME
///     errors       NAME = 'regular expression' for standard output, or a file, "errors.json"
///     values       the same, for numbers whose limit is not known
///     seconds      a regular expression; without it the process is timed
///     timeout      s
///     environment  NAME = "text"
///     parameters   NAME = number, text or true/false: more placeholders
///     solution     a file of equations, or one that is shipped: placeholders (SolutionFormulas)
///     language     what their formulas are written in (code_language_names)
///
/// Without formulas the solution is not derived, and its placeholders stay. Throws InputError where
/// a value is missing or breaks its rule, or a file is not there.
SolverBlock read_solver(TableReader table, const std::filesystem::path& folder, bool formulas);

/// Notes what the files hold now, by which runs are known: of another state none is made.
void note_contents(SolverBlock& solver);

/// What the blocks of studies may name: errors and values, and schemes that are other parameters.
/// The block must outlive it.
SolverKeys solver_keys(const SolverBlock& solver);

/// A set of parameters as a method, and back.
Method method_of(const SolverBlock& solver, const Parameters& parameters);
const Parameters& parameters_of(const Method& method);

/// The command as it stands in the scene, in one line.
std::string command_text(const SolverBlock& solver);

} // namespace tvbeam
