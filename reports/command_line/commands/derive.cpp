#include "mms/derived_formulas.hpp"
#include "mms/equations/code.hpp"
#include "mms/equations/system_checks.hpp"
#include "mms/equations/system_text.hpp"
#include "mms/text/visible_text.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/solution_report.hpp"
#include "reports/document/text_table.hpp"
#include "reports/files/output_file.hpp"
#include "reports/formats/formula_report.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/scene/solution_setting.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

struct DeriveOptions {
    std::string name;
    bool latex = false;
    std::string code;
    std::string out;
};

/// The file of equations that a name means; nothing: it means a solution or a scene.
std::optional<std::filesystem::path> equations_called(const std::string& name) {
    for (const auto& file : shipped_files(Shipped::equations))
        if (file.name == name)
            return file.path;
    std::error_code error;
    const bool is_file = name.find('/') != std::string::npos || name.ends_with(".toml");
    if (is_file && std::filesystem::exists(name, error) && is_equation_system(name))
        return name;
    return std::nullopt;
}

std::string text_of(const Remark& remark) {
    return InputError(remark.place, remark.text).what();
}

int derive_equations(const std::filesystem::path& file, const DeriveOptions& options) {
    DerivedSystem derived = derive_system(read_equation_system(file));
    const std::vector<Remark> remarks = checked_system(derived);
    const auto language = code_language(options.code);
    std::string text = language        ? system_code(derived, *language)
                       : options.latex ? system_latex(derived)
                                       : system_text(derived);
    require_no_input("--out", options.out, {file.string()});
    Destination out = destination(options.out.empty() ? "-" : options.out);
    const bool alone = language || options.latex;
    if (!alone && !remarks.empty())
        text += "\nWhat this tests, and what it does not\n";
    for (const auto& remark : remarks)
        if (alone)
            say(text_of(remark));
        else
            text += wrapped("  " + text_of(remark), 4);
    out.write(out.standard_output() ? visible(text) : text);
    return done;
}

int derive_solution(const std::string& name, bool latex) {
    const SolutionSetting setting = solution_setting(name);
    const Solution& solution = setting.solution;
    write_standard_output(
        visible(formula_report(
                    solution, derived_formulas(solution, setting.beam.stops.epsilon > 0.0), latex) +
                (latex ? "" : solution_report(setting))));
    return done;
}

int derive_command(const DeriveOptions& options) {
    if (const auto file = equations_called(options.name))
        return derive_equations(*file, options);
    if (!options.code.empty() || !options.out.empty()) {
        static_cast<void>(solution_setting(options.name)); // which refuses what is no name
        throw InputError({options.name},
                         "--code and --out are for files of equations; the beam of the scenes is "
                         "one, as `tvbeam derive beam --code c`");
    }
    return derive_solution(options.name, options.latex);
}

} // namespace

Command add_derive(CLI::App& app) {
    auto* derive = app.add_subcommand(
        "derive",
        "Print the f, G, m, theta0 and u0 that a solution demands, what of the model it tests, and "
        "the orders to expect of it; of a file of equations the sources, exact values, boundary "
        "and initial values, as code for a solver with --code.\n"
        "Example: tvbeam derive heat-2d --code c --out heat.c");
    const auto options = std::make_shared<DeriveOptions>();
    derive
        ->add_option("name", options->name,
                     "a shipped scene, solution or file of equations, or a file")
        ->required();
    auto* latex = derive->add_flag("--latex", options->latex, "the formulas alone, as LaTeX");
    derive->add_option("--code", options->code, "functions in a language")
        ->check(CLI::IsMember(code_language_names()))
        ->type_name("LANGUAGE")
        ->excludes(latex);
    add_file(*derive, "--out", options->out, "write to a file");
    return {derive, [options] { return derive_command(*options); }};
}

} // namespace tvbeam
