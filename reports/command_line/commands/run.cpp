#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shard_command.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/commands/shown_run.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"
#include "reports/files/finished_work.hpp"
#include "reports/files/report_directory.hpp"
#include "reports/files/solver_runs.hpp"
#include "reports/formats/csv_report.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/formats/report_format.hpp"
#include "reports/sweep/sweep.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace tvbeam {

namespace {

struct RunOptions {
    std::string scene;
    std::vector<std::string> overrides;
    std::string json;
    std::string csv;
    std::string out;
    std::string shard;
    bool resume = false;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

/// Whether a result says so of itself.
bool is_interrupted(const std::filesystem::path& result) {
    std::ifstream stream(result);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    const auto found = json.find("interrupted");
    return json.is_object() && found != json.end() && *found == true;
}

/// The finished runs in the directory of --out: of an attempt that was cut short, or those of an
/// external solver.
class KeptRuns {
public:
    KeptRuns(const RunOptions& options, const Scene& scene)
        : out_(options.out),
          adds_levels_(std::ranges::any_of(scene.blocks.entries(), [](const auto& entry) {
              return entry.kind->until(entry.value) != nullptr;
          })) {
        if (scene.solver) {
            solver_.emplace(out_, scene);
            torn_ = solver_->torn();
            return;
        }
        const auto file = out_ / "unfinished.jsonl";
        work_.emplace(scene, WorkOrigin{options.scene, options.overrides, {}});
        work_->keep_in(file);
        if (!std::filesystem::exists(file))
            return;
        if (!options.resume)
            throw InputError({file.string()},
                             "holds results of an attempt that was cut short; go on with it by "
                             "--resume, or remove the file");
        torn_ = work_->read(file);
    }
    FinishedRuns* finished() { return solver_ ? static_cast<FinishedRuns*>(&*solver_) : &*work_; }
    /// What is said before anything runs; empty: nothing.
    std::string greeting(bool resume) {
        const std::string torn = torn_.count == 0 ? "" : "; " + torn_.text();
        if (solver_) {
            const std::size_t found = solver_->found();
            return found == 0 && torn.empty()
                       ? ""
                       : "goes on with " + std::to_string(found) + " finished runs" +
                             (adds_levels_ ? ", and those of levels that are added," : "") +
                             " from " + solver_->path().string() + torn +
                             "; remove it to make them anew";
        }
        std::error_code error;
        if (resume && work_->found() == 0 && torn.empty() &&
            std::filesystem::exists(out_ / "result.json", error))
            return is_interrupted(out_ / "result.json")
                       ? "nothing was kept to go on with: " + out_.string() +
                             " holds the results of a run that was interrupted; it is made again"
                       : "nothing is left to go on with: " + out_.string() +
                             " holds the results of a run that ended; it is made again";
        return !resume ? ""
                       : "goes on with " + std::to_string(work_->found()) + " finished runs" + torn;
    }
    /// What the result says of runs that were not made; empty: nothing.
    [[nodiscard]] std::string remark() const { return solver_ ? solver_->remark() : ""; }
    /// What is said after an interruption.
    [[nodiscard]] std::string advice() const {
        if (solver_)
            return solver_->holds_runs() ? "; the same command goes on from the runs that are kept"
                                         : "";
        return work_->holds_runs() ? "; --resume goes on from the runs that are kept" : "";
    }
    void write() { solver_ ? solver_->write() : work_->write(); }
    /// Why results could not be kept; empty: they are.
    [[nodiscard]] const std::string& failure() const {
        return solver_ ? solver_->failure() : work_->failure();
    }
    /// The study has come to its end.
    void end() {
        if (work_)
            work_->remove();
    }

private:
    std::filesystem::path out_;
    bool adds_levels_; ///< by `until`, whose runs are found again as they come
    std::optional<FinishedWork> work_;
    std::optional<SolverRuns> solver_;
    TornLines torn_;
};

/// What there is to say of a run that did not go well; empty when it did.
std::string trouble_of(const StudyResult& result, bool interrupted,
                       const std::optional<KeptRuns>& kept) {
    if (interrupted)
        return "interrupted; the result holds what was finished" + (kept ? kept->advice() : "");
    return result.failed() ? "a run failed; the result says which and why" : "";
}

/// Files first: what standard output goes to may be gone. Text stands there where neither does.
void write_single_files(const StudyResult& result, Destination& json, Destination& csv,
                        bool quiet) {
    const auto write_csv = [&] {
        csv.write(csv_report(result));
        if (result.scene.defect && !quiet)
            say("the CSV holds results with a deliberate defect, not the problem's");
    };
    if (json.wanted() && !json.standard_output())
        json.write(json_report(result));
    if (csv.wanted() && !csv.standard_output())
        write_csv();
    if (json.standard_output())
        json.write(json_report(result));
    else if (csv.standard_output())
        write_csv();
    else if (!quiet)
        write_standard_output(text_document(result_document(result)));
}

int run_command(const RunOptions& options) {
    const Scene scene =
        read_scene(options.scene, options.overrides, {.report_files = report_format_names()});
    predict(scene, options.quiet, options.really_long);
    std::optional<ReportDirectory> out;
    std::optional<KeptRuns> kept;
    require_runnable(scene);
    require_no_input("--json", options.json, files_of(scene));
    require_no_input("--csv", options.csv, files_of(scene));
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
    // From here on there is something to keep.
    EndRequests end_requests([&] {
        const std::string advice = kept ? kept->advice() : "";
        out.reset();
        say_interrupted("interrupted in what could not be left in time; no report is written" +
                        advice);
    });
    StudyResult result =
        run_shown(scene, options.quiet, options.jobs, kept ? kept->finished() : nullptr);
    end_requests.settle();
    if (const std::string remark = kept ? kept->remark() : ""; !remark.empty())
        result.remarks.push_back(remark);
    bool interrupted = result.interrupted();
    if (out) {
        kept->write();
        interrupted = !write_reports(*out, reported(result)) || interrupted;
        if (!kept->failure().empty())
            say(kept->failure() + "; the runs behind it are not kept");
        if (!interrupted)
            kept->end();
    }
    write_single_files(result, json, csv, options.quiet);
    if (const std::string trouble = trouble_of(result, interrupted, kept); !trouble.empty()) {
        say(trouble);
        return run_failed;
    }
    return done;
}

/// The scene with each value of a sweep, and one table of all. With --out the summary goes to the
/// directory, and each result to one in it that is called by its value.
int sweep_command(const RunOptions& options, const Sweep& sweep) {
    if (options.resume)
        throw InputError({"--resume"}, "a sweep is not resumed; name one value with --set");
    std::vector<Scene> scenes;
    for (const auto& value : sweep.values) {
        scenes.push_back(read_scene(options.scene, sweep.overrides(value),
                                    {.report_files = report_format_names()}));
        require_names_of_rows(sweep, scenes.back());
        predict(scenes.back(), options.quiet, options.really_long);
        require_runnable(scenes.back());
    }
    require_no_input("--json", options.json, files_of(scenes.front()));
    require_no_input("--csv", options.csv, files_of(scenes.front()));
    std::optional<ReportDirectory> out;
    if (!options.out.empty())
        opened([&] { out.emplace(options.out, scenes.front().report); });
    Destination json = destination(options.json);
    Destination csv = destination(options.csv);
    EndRequests end_requests([&] {
        out.reset();
        say_interrupted("interrupted in what could not be left in time; no report is written");
    });
    std::vector<StudyResult> results;
    for (const auto& scene : scenes) {
        results.push_back(run_shown(scene, options.quiet, options.jobs, nullptr));
        if (results.back().interrupted())
            break;
    }
    end_requests.settle();
    const Reported all = reported(sweep, results);
    bool interrupted = all.interrupted;
    const auto write = [&](ReportDirectory& directory, const Reported& what) {
        interrupted = !write_reports(directory, what) || interrupted;
    };
    if (out) {
        write(*out, all);
        for (std::size_t i = 0; i < results.size(); ++i) {
            ReportDirectory one(std::filesystem::path(options.out) / sweep.directory(i),
                                scenes[i].report);
            write(one, reported(results[i]));
        }
    }
    if (json.wanted())
        json.write(all.json());
    if (csv.wanted())
        csv.write(sweep_csv(sweep, results));
    if (!json.standard_output() && !csv.standard_output() && !options.quiet)
        write_standard_output(text_document(all.document));
    if (interrupted || all.failed)
        say(interrupted ? "interrupted; the table holds what was finished"
                        : "a run failed; its row says so");
    return interrupted || all.failed ? run_failed : done;
}

} // namespace

Command add_run(CLI::App& app) {
    auto* run =
        app.add_subcommand("run", "Run the studies of a scene and print its table.\n"
                                  "Example: tvbeam run table1 --set beam.alpha=0 --csv table1.csv");
    const auto options = std::make_shared<RunOptions>();
    run->add_option("scene", options->scene, "a shipped scene, or a file")->required();
    add_overrides(*run, options->overrides,
                  "override a key: --set beam.alpha=1e3 (again and again); several values, "
                  "--set beam.alpha=0.1,1,10, give one table with a row each");
    add_file(*run, "--json", options->json,
             "write the result as JSON; -: to standard output, in place of the table");
    add_file(*run, "--csv", options->csv,
             "write the first of these that the scene has as CSV: ladder, grid of [orders], timed "
             "rows, evolution, stress cases, map of contraction, floors of round-off, sensitivity; "
             "-: to standard output, in place of the table. --out writes them all");
    add_directory(*run, options->out,
                  "write to a directory what the scene's [report] block asks for; without one, "
                  "JSON, CSV, Markdown, LaTeX, plots and a page of HTML");
    run->add_flag("--resume", options->resume,
                  "go on with an attempt that was cut short, whose finished runs are in the "
                  "directory of --out")
        ->needs("--out");
    run->add_option("--shard", options->shard,
                    "make only the Ith of N parts of all runs and cases, and keep them in the "
                    "directory of --out for tvbeam merge; started again, it goes on. auto/N: I is "
                    "SLURM_ARRAY_TASK_ID")
        ->type_name("I/N")
        ->needs("--out")
        ->excludes("--json")
        ->excludes("--csv")
        ->excludes("--resume");
    run->add_flag("--quiet", options->quiet, "no table, and no progress line");
    add_really_long(*run, options->really_long);
    add_jobs(*run, options->jobs);
    return {run, [options] {
                require_apart("--json", options->json, "--csv", options->csv);
                if (!options->shard.empty() && sweep_in(options->overrides))
                    throw InputError({"--shard"}, "parts one scene; name one value with --set");
                if (!options->shard.empty())
                    return shard_command({.scene = options->scene,
                                          .overrides = options->overrides,
                                          .shard = options->shard,
                                          .out = options->out,
                                          .quiet = options->quiet,
                                          .really_long = options->really_long,
                                          .jobs = options->jobs});
                if (const auto sweep = sweep_in(options->overrides))
                    return sweep_command(*options, *sweep);
                return run_command(*options);
            }};
}

} // namespace tvbeam
