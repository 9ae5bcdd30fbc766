// The command line. Exit: 0 done, 1 an expectation failed, 2 bad input or usage, 3 a run failed.

#include "mms/derived_formulas.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/toml_reader.hpp"
#include "reports/analysis/analysis_document.hpp"
#include "reports/analysis/analysis_reports.hpp"
#include "reports/command_line/check_report.hpp"
#include "reports/command_line/completion.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/command_line/new_solution.hpp"
#include "reports/command_line/progress_line.hpp"
#include "reports/command_line/solution_report.hpp"
#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"
#include "reports/document/text_table.hpp"
#include "reports/document/visible_text.hpp"
#include "reports/files/baseline.hpp"
#include "reports/files/checkpoint.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/report_directory.hpp"
#include "reports/files/solver_runs.hpp"
#include "reports/formats/csv_report.hpp"
#include "reports/formats/formula_report.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/formats/markdown_report.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/data/data_analysis.hpp"
#include "studies/data/data_check.hpp"
#include "studies/data/data_file.hpp"
#include "studies/gates/features.hpp"
#include "studies/predicted_work.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/scene/solution_setting.hpp"
#include "studies/study.hpp"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using namespace tvbeam;

enum Exit { done = 0, violated = 1, bad_input = 2, run_failed = 3 };

struct RunOptions {
    std::string scene;
    std::vector<std::string> overrides;
    std::string json;
    std::string csv;
    std::string out;
    bool resume = false;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

void say(const std::string& message) {
    std::fprintf(stderr, "tvbeam: %s\n", visible(message).c_str());
}

/// In place of a progress line that may stand there.
void say_interrupted(const std::string& message) {
    if (isatty(STDERR_FILENO) == 1)
        std::fputs("\r\033[K", stderr);
    say(message);
}

/// Where one report goes: nowhere, standard output (-), or a file.
class Destination {
public:
    explicit Destination(const std::string& name) : standard_output_(name == "-") {
        if (!name.empty() && !standard_output_)
            file_.emplace(name);
    }
    [[nodiscard]] bool wanted() const { return standard_output_ || file_; }
    [[nodiscard]] bool standard_output() const { return standard_output_; }
    void write(const std::string& text) {
        if (file_)
            file_->commit(text);
        else
            write_standard_output(text);
    }

private:
    bool standard_output_;
    std::optional<OutputFile> file_;
};

/// Whether two reports are wanted in the same file, or both on standard output.
bool same_place(const std::string& first, const std::string& second) {
    if (first.empty() || second.empty())
        return false;
    std::error_code error;
    return first == second || std::filesystem::weakly_canonical(first, error) ==
                                  std::filesystem::weakly_canonical(second, error);
}

/// Opens what results will go to, before anything runs: a place that cannot be written is bad
/// input.
template <typename Open>
auto opened(const Open& open) {
    try {
        return open();
    } catch (const OutputError& error) {
        throw InputError({}, error.what());
    }
}

Destination destination(const std::string& name) {
    return opened([&] { return Destination(name); });
}

/// From here on a prediction is said: seconds.
constexpr double worth_saying = 60.0;

/// Refuses what would take too long, and says of what takes long how long.
void predict(const Scene& scene, bool quiet, bool really_long) {
    const PredictedWork predicted = predicted_work(scene);
    if (!really_long)
        require_short_enough(scene, predicted);
    if (!quiet && predicted.seconds > worth_saying)
        say(scene.name + " asks for " + predicted.text());
}

StudyResult run_shown(const Scene& scene, bool quiet, int jobs, FinishedRuns* finished) {
    ProgressLine progress(!quiet);
    return run_study(scene, {.jobs = jobs, .progress = &progress, .finished = finished});
}

/// The finished runs in the directory of --out: of an attempt that was cut short, or those of an
/// external solver.
class KeptRuns {
public:
    KeptRuns(const RunOptions& options, const Scene& scene) {
        if (scene.solver)
            solver_.emplace(options.out, scene);
        else
            checkpoint_.emplace(options.out, scene, options.resume);
    }
    FinishedRuns* finished() {
        return solver_ ? static_cast<FinishedRuns*>(&*solver_) : &*checkpoint_;
    }
    /// What is said before anything runs; empty: nothing.
    std::string greeting(bool resume) {
        if (solver_) {
            const std::size_t found = solver_->found();
            return found == 0 ? ""
                              : "goes on with " + std::to_string(found) + " finished runs from " +
                                    solver_->path().string() + "; remove it to make them anew";
        }
        return !resume ? ""
                       : "goes on with " + std::to_string(checkpoint_->found()) + " finished runs" +
                             (checkpoint_->was_torn() ? "; one that was being written when it was "
                                                        "cut short is run again"
                                                      : "");
    }
    /// What is said after an interruption.
    [[nodiscard]] std::string advice() const {
        if (solver_)
            return solver_->holds_runs() ? "; the same command goes on from the runs that are kept"
                                         : "";
        return checkpoint_->holds_runs() ? "; --resume goes on from the runs that are kept" : "";
    }
    void write() { solver_ ? solver_->write() : checkpoint_->write(); }
    /// Why results could not be kept; empty: they are.
    [[nodiscard]] const std::string& failure() const {
        return solver_ ? solver_->failure() : checkpoint_->failure();
    }
    /// The study has come to its end.
    void end() {
        if (checkpoint_)
            checkpoint_->remove();
    }

private:
    std::optional<Checkpoint> checkpoint_;
    std::optional<SolverRuns> solver_;
};

/// What there is to say of a run that did not go well; empty when it did.
std::string trouble_of(const StudyResult& result, const std::optional<KeptRuns>& kept) {
    if (result.interrupted())
        return "interrupted; the result holds what was finished" + (kept ? kept->advice() : "");
    return result.failed() ? "a run failed; the result says which and why" : "";
}

int run_command(const RunOptions& options) {
    const Scene scene =
        read_scene(options.scene, options.overrides, {.report_files = report_format_names()});
    predict(scene, options.quiet, options.really_long);
    std::optional<ReportDirectory> out;
    std::optional<KeptRuns> kept;
    require_runnable(scene);
    if (!options.out.empty()) {
        opened([&] {
            out.emplace(options.out, scene.report);
            kept.emplace(options, scene);
        });
        if (const auto greeting = kept->greeting(options.resume);
            !greeting.empty() && !options.quiet)
            say(greeting);
    }
    Destination json = destination(options.json);
    Destination csv = destination(options.csv);
    if (scene.defect && csv.wanted() && !options.quiet)
        say("the CSV holds results with a deliberate defect, not the problem's");
    // From here on there is something to keep.
    EndRequests end_requests([&] {
        const std::string advice = kept ? kept->advice() : "";
        out.reset();
        say_interrupted("interrupted in what could not be left in time; no report is written" +
                        advice);
    });
    const StudyResult result =
        run_shown(scene, options.quiet, options.jobs, kept ? kept->finished() : nullptr);
    end_requests.settle();
    // Files first: what standard output goes to may be gone.
    if (out) {
        kept->write();
        if (const std::string left_out = out->write(reported(result)); !left_out.empty())
            say(left_out);
        if (!kept->failure().empty())
            say(kept->failure() + "; the runs behind it are not kept");
        if (!result.interrupted())
            kept->end();
    }
    if (json.wanted() && !json.standard_output())
        json.write(json_report(result));
    if (csv.wanted() && !csv.standard_output())
        csv.write(csv_report(result));
    if (json.standard_output())
        json.write(json_report(result));
    else if (csv.standard_output())
        csv.write(csv_report(result));
    else if (!options.quiet)
        write_standard_output(text_document(result_document(result)));
    if (const std::string trouble = trouble_of(result, kept); !trouble.empty()) {
        say(trouble);
        return run_failed;
    }
    return done;
}

struct CheckOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
    bool short_form = false;
    std::string junit;
    std::string record;
    std::string baseline;
    double tolerance = 1e-6;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

/// Colour on a terminal, unless NO_COLOR is set (https://no-color.org).
bool coloured() {
    const char* no_color = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (no_color == nullptr || *no_color == '\0');
}

std::vector<BaselineEntry> entries_of(const std::vector<StudyResult>& results) {
    std::vector<BaselineEntry> entries;
    entries.reserve(results.size());
    for (const auto& result : results)
        entries.push_back(baseline_entry(result));
    return entries;
}

constexpr const char* interrupted_reason = "it was interrupted";

int check_command(const CheckOptions& options) {
    // All scenes are read before any is run, so that a mistake in the last is not found after the
    // others' run.
    std::vector<Scene> scenes;
    for (const auto& name : options.scenes)
        scenes.push_back(read_scene(name, options.overrides,
                                    {.short_form = options.short_form,
                                     .expectations = true,
                                     .report_files = report_format_names()}));
    for (const auto& scene : scenes)
        predict(scene, options.quiet, options.really_long);
    const auto baseline =
        options.baseline.empty() ? std::nullopt : std::optional<Baseline>(options.baseline);
    for (const auto& scene : scenes)
        if (scene.expectations.empty() && !baseline && options.record.empty())
            throw InputError(
                {scene.file},
                "has no [expect] block, so there is nothing to check; add one, or record a "
                "baseline with --record");
    for (const auto& scene : scenes)
        require_runnable(scene);
    Destination junit = destination(options.junit);
    Destination record = destination(options.record);

    std::vector<StudyResult> results;
    std::vector<CheckedScene> checked;
    std::mutex mutex; // of what is checked
    const auto add = [&](const CheckedScene& one) {
        const std::scoped_lock lock(mutex);
        checked.push_back(one);
    };
    // From here on there is something to keep.
    EndRequests end_requests([&] {
        std::vector<CheckedScene> reported;
        {
            const std::scoped_lock lock(mutex);
            reported = checked;
        }
        const Scene& scene = scenes.at(std::min(reported.size(), scenes.size() - 1));
        if (reported.size() < scenes.size())
            reported.push_back({scene.name, 0.0, interrupted_reason, {}});
        say_interrupted("interrupted in " + scene.name);
        if (junit.wanted())
            junit.write(junit_report(reported));
    });
    for (const auto& scene : scenes) {
        const std::string shown = scene.name + (scene.defect ? " (with a deliberate defect)" : "");
        const auto start = std::chrono::steady_clock::now();
        results.push_back(run_shown(scene, options.quiet, options.jobs, nullptr));
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        if (results.back().interrupted()) {
            add({shown, elapsed.count(), interrupted_reason, {}});
            say_interrupted("interrupted in " + scene.name);
            break;
        }
        CheckedScene one{shown, elapsed.count(), results.back().ending().reason,
                         check(results.back())};
        if (baseline) {
            const auto more = baseline->check(baseline_entry(results.back()), options.tolerance);
            one.expectations.insert(one.expectations.end(), more.begin(), more.end());
        }
        if (!junit.standard_output() && !record.standard_output() &&
            !(options.quiet && one.passed()))
            write_standard_output(check_report(one, coloured()));
        add(one);
    }
    end_requests.settle();
    if (junit.wanted())
        junit.write(junit_report(checked));
    if (record.wanted() && !results.back().interrupted())
        record.write(baseline_of(entries_of(results)));
    add_to_step_summary(check_markdown(checked));
    const bool failed = std::any_of(results.begin(), results.end(),
                                    [](const StudyResult& result) { return result.failed(); });
    const bool passed = std::all_of(checked.begin(), checked.end(),
                                    [](const CheckedScene& scene) { return scene.passed(); });
    if (failed && !results.back().interrupted())
        say("a run failed; the report says which and why");
    return failed ? run_failed : passed ? done : violated;
}

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
    Destination record = destination(options.record);
    if (out)
        if (const std::string left_out = out->write(reported(analysis)); !left_out.empty())
            say(left_out);
    if (json.wanted())
        json.write(analysis_json(analysis));
    if (csv.wanted())
        csv.write(analysis_csv(analysis));
    if (junit.wanted())
        junit.write(junit_report({checked}));
    if (record.wanted())
        record.write(baseline_of({baseline_entry(analysis)}));
    const Document document = analysis_document(analysis);
    const bool gated = options.expect || baseline;
    if (!json.standard_output() && !csv.standard_output() && !junit.standard_output() &&
        !record.standard_output())
        write_standard_output(text_document(document) +
                              (gated ? "\n" + check_report(checked, coloured()) : ""));
    add_to_step_summary(markdown_report(document) + (gated ? check_markdown({checked}) : ""));
    return checked.passed() ? done : violated;
}

int derive_command(const std::string& name, bool latex) {
    const SolutionSetting setting = solution_setting(name);
    const Solution& solution = setting.solution;
    write_standard_output(
        visible(formula_report(
                    solution, derived_formulas(solution, setting.beam.stops.epsilon > 0.0), latex) +
                (latex ? "" : solution_report(setting))));
    return done;
}

int new_command(const std::string& name) {
    const auto files = starter_files(name);
    write_starter_files(files, ".");
    write_standard_output("wrote " + files[0].name + " (the solution) and " + files[1].name +
                          " (the scene); now\n  tvbeam run " + files[1].name +
                          "\n  tvbeam derive " + files[0].name + "\n");
    return done;
}

int new_solver_command(const std::string& name) {
    const auto files = solver_starter_files(name);
    write_starter_files(files, ".");
    write_standard_output("wrote " + files[0].name +
                          " (a solver to put your own in place of) and " + files[1].name +
                          " (the scene); now\n  tvbeam run " + files[1].name + "\n  tvbeam check " +
                          files[1].name + "\n");
    return done;
}

int names_command() {
    std::string text;
    for (const auto kind : {Shipped::scene, Shipped::solution})
        for (const auto& file : shipped_files(kind))
            text += file.name + "\n";
    write_standard_output(text);
    return done;
}

int list_command() {
    if (shipped_files(Shipped::scene).empty() && shipped_files(Shipped::solution).empty())
        throw InputError({"tvbeam list"}, "the shipped scenes and solutions are not where this "
                                          "program looks for them; name their directory, which "
                                          "holds studies/scenes, in TVBEAM_DATA");
    std::string text = "Scenes (tvbeam run NAME):\n";
    for (const auto& file : shipped_files(Shipped::scene))
        text += wrapped("  " + file.name + ": " + read_scene(file.path.string()).title, 4);
    text += "\nSolutions (solution = \"NAME\" in a scene, tvbeam derive NAME):\n";
    for (const auto& file : shipped_files(Shipped::solution)) {
        const Solution solution = read_solution(file.path);
        text += wrapped("  " + file.name + ": " +
                            (solution.purpose.empty() ? solution.source : solution.purpose),
                        4);
    }
    write_standard_output(visible(text));
    return done;
}

/// Those whose name holds the word, each with all its scenes; without a word a line each, with two.
int features_command(const std::string& word) {
    const FeatureTable table = feature_table();
    std::string text;
    std::string counts;
    const auto add = [&](const std::string& what, const std::vector<Feature>& features) {
        text += what + ":\n";
        std::size_t used = 0;
        for (const auto& [name, scenes] : features) {
            used += scenes.empty() ? 0 : 1;
            if (name.find(word) == std::string::npos)
                continue;
            const bool all = !word.empty() || scenes.size() <= 2;
            const auto shown = std::span(scenes).first(all ? scenes.size() : 2);
            const std::string line =
                scenes.empty()
                    ? "none"
                    : fmt::format("{} scene{}: {}{}", scenes.size(), scenes.size() == 1 ? "" : "s",
                                  fmt::join(shown, ", "), all ? "" : ", …");
            text += word.empty() ? fmt::format("  {}: {}\n", name, line)
                                 : wrapped(fmt::format("  {}: {}", name, line), 4);
        }
        text += "\n";
        counts +=
            fmt::format("{}: {} of {} in a scene with [expect]\n", what, used, features.size());
    };
    add("Features", table.features);
    add("Pairs of what a run consists of", table.pairs);
    text += "Needed in no scene:\n";
    for (const auto& [name, reason] : table.exceptions)
        text += wrapped(fmt::format("  {}: {}", name, reason), 4);
    write_standard_output(text + "\n" + counts);
    return done;
}

void add_really_long(CLI::App& command, bool& really_long) {
    command.add_flag("--yes-really-long", really_long,
                     "also what is predicted to take more than 6 h or 4 GB");
}

void add_jobs(CLI::App& command, int& jobs) {
    constexpr int most = 1024;
    command
        .add_option(
            "--jobs", jobs,
            "runs at a time: of a ladder, of the grid of [orders], of the cases of [stress]; the "
            "results do not depend on it. [work_precision] times one run after the other all the "
            "same")
        ->check(CLI::Range(1, most))
        ->type_name("N")
        ->capture_default_str();
}

/// Refuses the empty name that an unset variable of a shell makes.
const CLI::Validator named(
    [](std::string& name) {
        return name.empty() ? std::string("its name is empty; name a file or a directory") : "";
    },
    "", "named");
const CLI::Validator no_stream(
    [](std::string& name) {
        return name == "-" ? std::string("a directory is wanted, and - is none") : "";
    },
    "", "no stream");

const CLI::Validator narrow(
    [](std::string& text) {
        double part = 0.0;
        const bool holds =
            CLI::detail::lexical_cast(text, part) && part > 0.0 && part <= widest_part;
        return holds ? std::string() : text + " is no part > 0 and at most 0.5 of a figure";
    },
    "", "narrow");

std::vector<std::string> names_of_commands(const CLI::App& app) {
    const auto all = app.get_subcommands([](const CLI::App*) { return true; });
    std::vector<std::string> commands;
    commands.reserve(all.size());
    for (const auto* command : all)
        commands.push_back(command->get_name());
    return commands;
}

/// A command of the program, and what it does when it is called.
struct Command {
    CLI::App* app;
    std::function<int()> call;
};

void add_overrides(CLI::App& command, std::vector<std::string>& overrides,
                   const std::string& description) {
    command.add_option("--set", overrides, description)
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
}

void add_file(CLI::App& command, const std::string& option, std::string& file,
              const std::string& description) {
    command.add_option(option, file, description)->check(named)->type_name("FILE|-");
}

void add_directory(CLI::App& command, std::string& directory, const std::string& description) {
    command.add_option("--out", directory, description)
        ->check(named)
        ->check(no_stream)
        ->type_name("DIR");
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

void add_baseline(CLI::App& command, std::string& file, double& tolerance,
                  const std::string& figure) {
    command.add_option("--baseline", file, "hold every " + figure + " against a recorded baseline")
        ->type_name("FILE");
    command.add_option("--tolerance", tolerance, "relative, both sides, for --baseline")
        ->check(narrow)
        ->capture_default_str();
}

/// Throws InputError where two options name one place.
void require_apart(const std::string& first, const std::string& file, const std::string& second,
                   const std::string& other) {
    if (same_place(file, other))
        throw InputError({first + " " + file + " " + second + " " + other},
                         "two reports do not fit in one place; give one of them another");
}

Command add_run(CLI::App& app) {
    auto* run =
        app.add_subcommand("run", "Run the studies of a scene and print its table.\n"
                                  "Example: tvbeam run table1 --set beam.alpha=0 --csv table1.csv");
    const auto options = std::make_shared<RunOptions>();
    run->add_option("scene", options->scene, "a shipped scene, or a file")->required();
    add_overrides(*run, options->overrides,
                  "override a key: --set beam.alpha=1e3 (again and again)");
    add_file(*run, "--json", options->json,
             "write the result as JSON; -: to standard output, in place of the table");
    add_file(*run, "--csv", options->csv,
             "write the first of these that the scene has as CSV: ladder, grid of [orders], timed "
             "rows, evolution, stress cases; -: to standard output, in place of the table. --out "
             "writes them all");
    add_directory(*run, options->out,
                  "write to a directory what the scene's [report] block asks for; without one, "
                  "JSON, CSV, Markdown, LaTeX, plots and a page of HTML");
    run->add_flag("--resume", options->resume,
                  "go on with an attempt that was cut short, whose finished runs are in the "
                  "directory of --out")
        ->needs("--out");
    run->add_flag("--quiet", options->quiet, "no table, and no progress line");
    add_really_long(*run, options->really_long);
    add_jobs(*run, options->jobs);
    return {run, [options] {
                require_apart("--json", options->json, "--csv", options->csv);
                return run_command(*options);
            }};
}

Command add_check(CLI::App& app) {
    auto* check = app.add_subcommand(
        "check", "Run scenes and check them against their [expect] blocks; exit 1 "
                 "and a line for each violation.\n"
                 "Example: tvbeam check table1 table1-orders --short --junit results.xml");
    const auto options = std::make_shared<CheckOptions>();
    check->add_option("scenes", options->scenes, "shipped scenes, or files")->required();
    add_overrides(*check, options->overrides, "override a key in every scene (again and again)");
    check->add_flag("--short", options->short_form,
                    "with the scenes' [short] blocks: the form for CI");
    add_file(*check, "--junit", options->junit, "write JUnit XML");
    add_file(*check, "--record", options->record, "write a baseline of every error found");
    add_baseline(*check, options->baseline, options->tolerance, "error");
    check->add_flag("--quiet", options->quiet, "only the scenes that fail, and no progress line");
    add_really_long(*check, options->really_long);
    add_jobs(*check, options->jobs);
    return {check, [options] {
                require_apart("--junit", options->junit, "--record", options->record);
                return check_command(*options);
            }};
}

void add_choice(CLI::App& analyse, DataChoice& choice) {
    const auto names = [&](const char* option, std::vector<std::string>& list, const char* what) {
        analyse.add_option(option, list, what)->delimiter(',')->type_name("NAME,...");
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
}

Command add_analyse(CLI::App& app) {
    auto* analyse = app.add_subcommand(
        "analyse", "Observed orders, verdicts and limits for any solver's errors or values: a "
                   "file of records with a line of names.\n"
                   "Example: tvbeam analyse errors.csv --size ndofs --dimension 2 --error L2,H1");
    const auto options = std::make_shared<AnalyseOptions>();
    analyse
        ->add_option("file", options->file,
                     "the file, fields separated by commas, tabs, semicolons or blanks; -: "
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

Command add_new(CLI::App& app) {
    auto* make = app.add_subcommand(
        "new", "Write a solution to start from, NAME.toml, and a scene that runs it, "
               "NAME-scene.toml, into the current directory.\nExample: tvbeam new my-solution");
    const auto solver = std::make_shared<bool>(false);
    make->add_flag(
        "--solver", *solver,
        "a small solver in Python, NAME.py, and a scene that runs it, NAME.toml: to study "
        "a solver of your own");
    const auto name = std::make_shared<std::string>();
    make->add_option("name", *name, "letters, digits, - and _")->required()->type_name("NAME");
    return {make,
            [name, solver] { return *solver ? new_solver_command(*name) : new_command(*name); }};
}

Command add_list(CLI::App& app) {
    auto* list =
        app.add_subcommand("list", "List the shipped scenes and solutions.\nExample: tvbeam list");
    const auto names = std::make_shared<bool>(false);
    const auto word = std::make_shared<std::string>();
    list->add_flag("--names", *names, "the names alone, one a line");
    const auto* features =
        list->add_option("--features", *word,
                         "what scenes can use, and which of those with [expect] do, also in pairs; "
                         "with a word, those with it in their names, and all their scenes")
            ->expected(0, 1)
            ->type_name("[WORD]")
            ->excludes("--names");
    return {list, [names, word, features] {
                return features->count() > 0 ? features_command(*word)
                       : *names              ? names_command()
                                             : list_command();
            }};
}

Command add_completion(CLI::App& app) {
    auto* completion = app.add_subcommand(
        "completion", "Print a script by which bash (and zsh, after bashcompinit) completes "
                      "commands, options and names.\n"
                      "Example: source <(tvbeam completion)");
    return {completion, [&app] {
                write_standard_output(completion_script(app));
                return done;
            }};
}

int command_line(int argc, char** argv) {
    CLI::App app(
        "Verification and convergence studies for a thermoviscoelastic beam between two stops.\n"
        "Exit: 0 done, 1 an expectation failed, 2 bad input or usage, 3 a run failed.");
    app.name("tvbeam");
    app.set_version_flag("--version", "tvbeam " TVBEAM_VERSION);
    app.require_subcommand(1);
    const std::vector<Command> commands{add_run(app),       add_check(app), add_analyse(app),
                                        add_derive(app),    add_new(app),   add_list(app),
                                        add_completion(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const auto words = app.remaining();
        if (app.get_subcommands().empty() && !words.empty() && !words[0].starts_with('-'))
            throw InputError({"'" + words[0] + "'"},
                             "is not a command" + did_you_mean(words[0], names_of_commands(app)) +
                                 "; tvbeam --help lists them");
        return app.exit(error) == 0 ? done : bad_input;
    }
    const auto called = std::find_if(commands.begin(), commands.end(),
                                     [](const Command& one) { return one.app->parsed(); });
    return called->call();
}

/// Words take memory, too.
void say_no_memory() {
    std::fputs("tvbeam: there is not enough memory\n", stderr);
}

/// Libraries run out of memory also where they say that they throw nothing. Those of C++ then do
/// not tell what was thrown.
[[noreturn]] void terminate_said() {
    try {
        if (const auto exception = std::current_exception())
            std::rethrow_exception(exception);
        std::fputs("tvbeam: cannot go on; is there enough memory?\n", stderr);
        std::_Exit(run_failed);
    } catch (const std::bad_alloc&) {
        say_no_memory();
        std::_Exit(run_failed);
    } catch (...) {
        std::abort();
    }
}

int reported_command_line(int argc, char** argv) {
    try {
        return command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const InputError& error) {
        say(error.what());
        return bad_input;
    } catch (const std::exception& error) {
        say(error.what());
        return run_failed;
    }
}

} // namespace

int main(int argc, char** argv) {
    // A closed pipe then fails the write, which is reported like any other.
    std::signal(SIGPIPE, SIG_IGN);
    std::set_terminate(&terminate_said);
    try {
        return reported_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        say_no_memory();
        return run_failed;
    }
}
