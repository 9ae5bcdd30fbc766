#include "mms/text/input_error.hpp"
#include "mms/text/visible_text.hpp"
#include "reports/command_line/check_report.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/record.hpp"
#include "reports/command_line/commands/refusal.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/commands/shown_run.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/document/json_text.hpp"
#include "reports/files/baseline.hpp"
#include "reports/formats/json_report.hpp"
#include "reports/formats/report_format.hpp"
#include "reports/sweep/sweep.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

struct CheckOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
    bool short_form = false;
    std::string json;
    std::string junit;
    std::string record;
    bool whole = false;
    std::string baseline;
    double tolerance = 1e-6;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

std::string recorded_report(const std::vector<BaselineEntry>& entries, const std::string& file) {
    std::string text;
    for (const auto& entry : entries) {
        const auto failed = std::ranges::count_if(
            entry.figures, [](const auto& figure) { return !std::isfinite(figure.second); });
        text += fmt::format("recorded {} numbers{} of {} in {}\n",
                            entry.figures.size() - static_cast<std::size_t>(failed),
                            failed > 0 ? fmt::format(" and {} that failed", failed) : "",
                            visible(entry.name), visible(file));
    }
    return text;
}

std::string own_program() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).string();
}

constexpr const char* interrupted_reason = "it was interrupted";

/// All scenes are read before any is run, so that a mistake in the last is not found after the
/// others' run.
std::vector<Scene> read_scenes(const CheckOptions& options) {
    if (const auto sweep = sweep_in(options.overrides))
        throw InputError({"--set " + sweep->key},
                         "has several values, which tvbeam run puts into one table; name one here");
    std::vector<Scene> scenes;
    for (const auto& name : options.scenes)
        scenes.push_back(read_scene(name, options.overrides,
                                    {.short_form = options.short_form,
                                     .expectations = true,
                                     .report_files = report_format_names(),
                                     .program = own_program()}));
    for (const auto& scene : scenes)
        predict(scene, options.quiet, options.really_long);
    return scenes;
}

/// That every scene runs, and has something to be checked against or recorded.
void require_checkable(const std::vector<Scene>& scenes, const CheckOptions& options) {
    const bool is_compared = !options.baseline.empty() || !options.record.empty();
    for (const auto& scene : scenes)
        if (scene.expectations.empty() && !is_compared)
            throw InputError(
                {scene.file},
                "has no [expect] block, so there is nothing to check; add one, or record a "
                "baseline with --record");
    if (!options.json.empty() && scenes.size() > 1)
        throw InputError({"--json"}, "takes the result of one scene; name one, or give --junit, "
                                     "which takes what is found of all");
    std::set<std::string> recorded;
    require_no_input("--json", options.json, {options.baseline});
    require_no_input("--junit", options.junit, {options.baseline});
    for (const auto& scene : scenes) {
        require_runnable(scene);
        require_no_input("--json", options.json, files_of(scene));
        require_no_input("--junit", options.junit, files_of(scene));
        require_no_input("--record", options.record, files_of(scene));
        if (is_compared)
            require_recordable(scene);
        if (!options.record.empty())
            require_another_name(recorded, scene.name, {scene.file});
    }
}

/// Scenes that are run and checked one after the other, and what is written of them.
class SceneChecks {
public:
    SceneChecks(const CheckOptions& options, const std::vector<Scene>& scenes,
                const std::optional<Baseline>& baseline)
        : options_(options), scenes_(scenes), baseline_(baseline), json_(destination(options.json)),
          junit_(destination(options.junit)), record_(options.record) {
        for (const auto& scene : scenes) {
            BaselineEntry entry{scene.name, {scene.file}, {}};
            entry.file = scene.file;
            entry.said = options.whole ? "{}" : "";
            record_.require_room(entry);
        }
    }

    void run_all() {
        // From here on there is something to keep.
        EndRequests end_requests([this] { keep_what_is_checked(); });
        for (const auto& scene : scenes_)
            if (!run_one(scene))
                break;
        end_requests.settle();
    }

    void write() {
        write_with_junit(junit_, "check", checked_, [this] { write_others(); });
    }

    void write_others() {
        if (json_.wanted())
            json_.write(json_text(result_));
        if (record_.wanted() && !interrupted_) {
            record_.write(entries_);
            if (!is_piped() && !options_.quiet)
                show(recorded_report(entries_, options_.record));
        }
        add_to_step_summary(check_markdown(checked_));
        if (lost_)
            std::rethrow_exception(lost_);
    }

    [[nodiscard]] int exit_code() const {
        if (failed_ && !interrupted_)
            say("a run failed; the report says which and why");
        return failed_                                                ? run_failed
               : std::ranges::all_of(checked_, &CheckedScene::passed) ? done
                                                                      : violated;
    }

private:
    /// Whether the next may be run.
    bool run_one(const Scene& scene) {
        const auto start = std::chrono::steady_clock::now();
        const StudyResult result = run_shown(scene, options_.quiet, options_.jobs, nullptr);
        const auto elapsed = [&start] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        };
        failed_ = failed_ || result.failed();
        interrupted_ = result.interrupted();
        CheckedScene one{scene.name + (scene.defect ? " (with a deliberate defect)" : ""),
                         0.0,
                         interrupted_ ? interrupted_reason : result.ending().reason,
                         {}};
        if (interrupted_)
            say_interrupted("interrupted in " + scene.name);
        else
            compare(one, result, scene.name);
        one.seconds = elapsed(); // what is expected may take its time, too
        if (!interrupted_)
            show_checked(one);
        if (json_.wanted()) {
            result_ = result_json(result);
            result_["check"] = check_json(one);
        }
        const std::scoped_lock lock(mutex_);
        checked_.push_back(one);
        return !interrupted_;
    }

    void compare(CheckedScene& one, const StudyResult& result, const std::string& name) {
        one.expectations = check(result);
        const auto entry = [&](bool whole) {
            return whole ? whole_entry(result, one.expectations) : baseline_entry(result);
        };
        if (record_.wanted())
            entries_.push_back(entry(options_.whole));
        if (!baseline_)
            return;
        const auto more = baseline_->check(entry(baseline_->has_said(name)), options_.tolerance);
        one.expectations.insert(one.expectations.end(), more.begin(), more.end());
    }

    void show_checked(const CheckedScene& one) {
        const bool only_recorded = record_.wanted() && one.passed() && one.expectations.empty();
        if (!is_piped() && !only_recorded && !(options_.quiet && one.passed()))
            show(check_report(one, coloured()));
    }

    /// Whether what is written, and not what is shown, goes to standard output.
    [[nodiscard]] bool is_piped() const {
        return json_.standard_output() || junit_.standard_output() || record_.standard_output();
    }

    /// Files do not depend on what standard output takes.
    void show(const std::string& text) {
        try {
            if (!lost_)
                write_standard_output(text);
        } catch (const OutputError&) {
            if (!json_.wanted() && !junit_.wanted() && !record_.wanted())
                throw;
            lost_ = std::current_exception();
        }
    }

    /// Where the process is about to end.
    void keep_what_is_checked() {
        std::vector<CheckedScene> reported;
        {
            const std::scoped_lock lock(mutex_);
            reported = checked_;
        }
        const Scene& scene = scenes_.at(std::min(reported.size(), scenes_.size() - 1));
        if (reported.size() < scenes_.size())
            reported.push_back({scene.name, 0.0, interrupted_reason, {}});
        say_interrupted("interrupted in " + scene.name);
        if (junit_.wanted())
            junit_.write(junit_report(reported));
    }

    const CheckOptions& options_;
    const std::vector<Scene>& scenes_;
    const std::optional<Baseline>& baseline_;
    Destination json_;
    Destination junit_;
    Record record_;
    nlohmann::ordered_json result_;      ///< of the one scene, with what is found of it
    std::vector<BaselineEntry> entries_; ///< to be recorded
    std::vector<CheckedScene> checked_;
    std::mutex mutex_; ///< of checked_
    bool failed_ = false;
    bool interrupted_ = false;
    std::exception_ptr lost_; ///< of what standard output did not take
};

int check_command(const CheckOptions& options) {
    const std::vector<Scene> scenes = read_scenes(options);
    const auto baseline =
        options.baseline.empty() ? std::nullopt : std::optional<Baseline>(options.baseline);
    require_checkable(scenes, options);
    SceneChecks checked(options, scenes, baseline);
    opened([] { add_to_step_summary({}); });
    checked.run_all();
    checked.write();
    return checked.exit_code();
}

} // namespace

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
    add_file(*check, "--json", options->json,
             "write the result of one scene as JSON, with a block \"check\": what it violates");
    add_file(*check, "--junit", options->junit, "write JUnit XML");
    add_file(*check, "--record", options->record, "write a baseline of every error found");
    check
        ->add_flag("--whole", options->whole,
                   "record all that results say, too: orders, verdicts, reasons, remarks, ...")
        ->needs("--record");
    add_baseline(*check, options->baseline, options->tolerance, "error");
    check->add_flag("--quiet", options->quiet, "only the scenes that fail, and no progress line");
    add_really_long(*check, options->really_long);
    add_jobs(*check, options->jobs);
    return {check, [options] {
                require_apart("--json", options->json, "--junit", options->junit);
                require_apart("--json", options->json, "--record", options->record);
                require_apart("--junit", options->junit, "--record", options->record);
                return check_command(*options);
            }};
}

} // namespace tvbeam
