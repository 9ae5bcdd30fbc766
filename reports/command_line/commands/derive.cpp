#include "mms/derived_formulas.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/solution_report.hpp"
#include "reports/document/visible_text.hpp"
#include "reports/files/output_file.hpp"
#include "reports/formats/formula_report.hpp"
#include "studies/scene/solution_setting.hpp"

#include <memory>
#include <string>

namespace tvbeam {

namespace {

int derive_command(const std::string& name, bool latex) {
    const SolutionSetting setting = solution_setting(name);
    const Solution& solution = setting.solution;
    write_standard_output(
        visible(formula_report(
                    solution, derived_formulas(solution, setting.beam.stops.epsilon > 0.0), latex) +
                (latex ? "" : solution_report(setting))));
    return done;
}

} // namespace

Command add_derive(CLI::App& app) {
    auto* derive = app.add_subcommand(
        "derive", "Print the f, G, m, theta0 and u0 that a solution demands, what of the "
                  "model it tests, and the orders to expect of it.\n"
                  "Example: tvbeam derive copetti-fernandez-2011 --latex");
    const auto name = std::make_shared<std::string>();
    const auto latex = std::make_shared<bool>(false);
    derive->add_option("name", *name, "a shipped scene or solution, or a file")->required();
    derive->add_flag("--latex", *latex, "the formulas alone, as LaTeX");
    return {derive, [name, latex] { return derive_command(*name, *latex); }};
}

} // namespace tvbeam
