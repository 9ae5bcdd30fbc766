#include "reports/analysis/analysis_document.hpp"
#include "reports/analysis/analysis_reports.hpp"
#include "reports/command_line/check_report.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/record.hpp"
#include "reports/command_line/commands/refusal.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/document/text_document.hpp"
#include "reports/files/baseline.hpp"
#include "reports/files/report_directory.hpp"
#include "reports/formats/markdown_report.hpp"
#include "studies/data/data_analysis.hpp"
#include "studies/data/data_check.hpp"
#include "studies/data/data_file.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

struct AnalyseOptions {
    std::string file;
    DataChoice choice;
    std::string json;
    std::string csv;
    std::string out;
    std::optional<std::string> expect;
    std::string junit;
    std::string record;
    std::string baseline;
    double tolerance = 1e-6;
};

int analyse_command(const AnalyseOptions& options) {
    const auto baseline =
        options.baseline.empty() ? std::nullopt : std::optional<Baseline>(options.baseline);
    const DataAnalysis analysis = analyse(read_data(options.file, options.choice));
    std::vector<std::string> inputs{options.file};
    if (options.expect)
        inputs.push_back(*options.expect);
    require_no_input("--record", options.record, inputs); // a baseline may be recorded anew
    inputs.push_back(options.baseline);
    require_no_input("--json", options.json, inputs);
    require_no_input("--csv", options.csv, inputs);
    require_no_input("--junit", options.junit, inputs);
    CheckedScene checked{analysis.name, 0.0, {}, {}};
    if (options.expect)
        checked.expectations = check(analysis, *options.expect);
    if (baseline) {
        const auto more = baseline->check(baseline_entry(analysis), options.tolerance);
        checked.expectations.insert(checked.expectations.end(), more.begin(), more.end());
    }
    std::optional<ReportDirectory> out;
    if (!options.out.empty())
        opened([&] { out.emplace(options.out, ReportBlock{}); });
    Destination json = destination(options.json);
    Destination csv = destination(options.csv);
    Destination junit = destination(options.junit);
    Record record(options.record);
    record.require_room(baseline_entry(analysis));
    opened([] { add_to_step_summary({}); });
    const Document document = analysis_document(analysis);
    const bool gated = options.expect || baseline;
    write_with_junit(junit, "analyse", {checked}, [&] {
        if (out)
            if (const std::string left_out = out->write(reported(analysis)); !left_out.empty())
                say(left_out);
        if (json.wanted())
            json.write(analysis_json(analysis));
        if (csv.wanted())
            csv.write(analysis_csv(analysis));
        if (record.wanted())
            record.write({baseline_entry(analysis)});
        if (!json.standard_output() && !csv.standard_output() && !junit.standard_output() &&
            !record.standard_output())
            write_standard_output(text_document(document) +
                                  (gated ? "\n" + check_report(checked, coloured()) : ""));
        add_to_step_summary(markdown_report(document) + (gated ? check_markdown({checked}) : ""));
    });
    return checked.passed() ? done : violated;
}

/// CLI11's own takes NaN for positive.
CLI::Validator positive_number() {
    return {[](const std::string& text) {
                double value = 0;
                const bool holds = CLI::detail::lexical_cast(text, value) && is_positive(value);
                return holds ? std::string() : "'" + text + "' is no positive number";
            },
            "POSITIVE"};
}

void add_choice(CLI::App& analyse, DataChoice& choice) {
    const auto names = [&](const char* option, std::vector<std::string>& list, const char* what) {
        analyse.add_option(option, list, what)->type_name("NAME,...");
    };
    names("--size", choice.sizes,
          "columns of mesh widths, or of numbers of cells, unknowns, ...; default: h or elements");
    analyse
        .add_option("--dimension", choice.dimension,
                    "sizes are numbers n of what fills a domain of this dimension: h = n^(-1/D)")
        ->check(positive_number())
        ->type_name("D");
    analyse.add_option("--step", choice.step, "the column of time steps; default: dt")
        ->type_name("NAME");
    names("--error", choice.errors, "columns of errors; default: error");
    names("--value", choice.values,
          "columns of computed numbers whose limit is not known; default: value, where there are "
          "no errors");
    analyse.add_option("--sigma", choice.sigma, "the column of standard deviations of the figures")
        ->type_name("NAME");
    analyse
        .add_option(
            "--where", choice.where,
            "only rows whose column has this text or number, e.g. scheme=Euler; NAME=*: all "
            "rows together, as one series, whatever the column has. Repeatable")
        ->expected(1)
        ->take_all()
        ->type_name("NAME=TEXT");
}

} // namespace

Command add_analyse(CLI::App& app) {
    auto* analyse = app.add_subcommand(
        "analyse", "Observed orders, verdicts and limits for any solver's errors or values: a "
                   "file of records with a line of names.\n"
                   "Example: tvbeam analyse errors.csv --size ndofs --dimension 2 --error L2,H1");
    const auto options = std::make_shared<AnalyseOptions>();
    analyse
        ->add_option("file", options->file,
                     "the file, fields separated by commas, tabs, semicolons or blanks, or a table "
                     "of Markdown; -: "
                     "standard input")
        ->required();
    add_choice(*analyse, options->choice);
    add_file(*analyse, "--json", options->json, "write the analysis as JSON");
    add_file(*analyse, "--csv", options->csv, "write the rows with orders and verdicts as CSV");
    add_directory(*analyse, options->out,
                  "write JSON, CSV, Markdown, LaTeX, plots and a page of HTML to a directory");
    analyse
        ->add_option("--expect", options->expect,
                     "hold the analysis against expectations: a TOML file, or a text as 'L2.order "
                     "= [1.9, 2.1]'")
        ->type_name("FILE|TEXT");
    add_file(*analyse, "--junit", options->junit, "write JUnit XML");
    add_file(*analyse, "--record", options->record, "write a baseline of every number");
    add_baseline(*analyse, options->baseline, options->tolerance, "number");
    return {analyse, [options] {
                const std::pair<const char*, const std::string&> files[] = {
                    {"--json", options->json},
                    {"--csv", options->csv},
                    {"--junit", options->junit},
                    {"--record", options->record}};
                for (std::size_t i = 0; i < std::size(files); ++i)
                    for (std::size_t k = i + 1; k < std::size(files); ++k)
                        require_apart(files[i].first, files[i].second, files[k].first,
                                      files[k].second);
                return analyse_command(*options);
            }};
}

} // namespace tvbeam
