#include "mms/text/input_error.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/commands/shell_words.hpp"
#include "reports/command_line/commands/shown_run.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/command_line/progress_line.hpp"
#include "reports/document/result_document.hpp"
#include "reports/document/text_document.hpp"
#include "reports/files/report_directory.hpp"
#include "reports/files/shard_files.hpp"
#include "reports/formats/report_format.hpp"
#include "studies/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

struct MergeOptions {
    std::string directory;
    std::string scene;
    bool status = false;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

/// Everything that shards have done of a scene.
class Merged {
public:
    explicit Merged(const MergeOptions& options)
        : directory_(options.directory), files_(shard_files_in(directory_)),
          origin_(origin_of(files_)), name_(options.scene.empty() ? origin_.scene : options.scene),
          scene_(read(name_)), work_(scene_, {origin_.scene, origin_.overrides, {}}) {
        std::string torn;
        for (const auto& [shard, file] : files_.files)
            if (const TornLines lines = work_.read(file); lines.count > 0)
                torn += (torn.empty() ? "" : "; ") + file.string() + ": " + lines.text();
        states_ = shard_states(work_, files_.of);
        if (!torn.empty() && !complete())
            say(torn + "; their shards make what is missing again");
    }

    [[nodiscard]] const Scene& scene() const { return scene_; }
    FinishedWork& work() { return work_; }
    [[nodiscard]] bool complete() const { return unfinished().empty(); }
    [[nodiscard]] bool has_failures() const { return !with_failures().empty(); }

    /// What is there and what is missing, by shard, and the command that makes it.
    [[nodiscard]] std::string status() const {
        std::string text = fmt::format("{:>8} {:>10} {:>10} {:>10} {:>10}\n", "shard", "runs",
                                       "done", "missing", "failed");
        const auto add = [&text](const std::string& name, const ShardState& state) {
            text += fmt::format("{:>8} {:>10} {:>10} {:>10} {:>10}\n", name, state.dealt,
                                state.done, state.dealt - state.done, state.failed);
        };
        ShardState all;
        for (const auto& state : states_) {
            add(std::to_string(state.shard.number), state);
            all.dealt += state.dealt;
            all.done += state.done;
            all.failed += state.failed;
        }
        add("all", all);
        text += complete() ? "nothing is missing: tvbeam merge " + word(directory_) +
                                 rest_of(is_too_long(scene_, predicted_merge(scene_))) + "\n"
                           : "what is missing is made by\n  " + command(unfinished()) + "\n";
        if (const auto numbers = with_failures(); !numbers.empty())
            text += "what failed is made again by\n  " + command(numbers) + "\n";
        return text;
    }

    /// "of 7 shards 2 are not whole (3, 5): 12 of 80 runs are missing".
    [[nodiscard]] std::string missing() const {
        std::size_t dealt = 0;
        std::size_t done = 0;
        for (const auto& state : states_) {
            dealt += state.dealt;
            done += state.done;
        }
        return fmt::format("of {} shards {} {} not whole ({}): {} of {} runs are missing",
                           files_.of, unfinished().size(), unfinished().size() == 1 ? "is" : "are",
                           ranges(unfinished()), dealt - done, dealt);
    }

private:
    /// That of the first file that has one: others may have been begun only.
    static WorkOrigin origin_of(const ShardFiles& files) {
        std::optional<WorkOrigin> found;
        for (const auto& [shard, file] : files.files) {
            const auto origin = work_origin_of(file);
            if (!origin)
                continue;
            if (!origin->shard || origin->shard->name() != shard.name())
                throw InputError({file.string()}, "holds another shard than its name says; remove "
                                                  "it, or give it its name again");
            if (!found)
                found = origin;
        }
        if (!found)
            throw InputError({files.files.front().second.string()},
                             "has no whole line that says what it is of, nor has another shard; "
                             "remove the files to make their runs anew");
        return *found;
    }
    [[nodiscard]] Scene read(const std::string& name) const {
        try {
            return read_scene(name, origin_.overrides, {.report_files = report_format_names()});
        } catch (const InputError& error) {
            throw InputError({}, std::string(error.what()) + " (the scene of the shards in " +
                                     directory_ + "; --scene names it where it stands elsewhere)");
        }
    }
    [[nodiscard]] std::vector<std::uint32_t> unfinished() const {
        std::vector<std::uint32_t> numbers;
        for (const auto& state : states_)
            if (state.done < state.dealt)
                numbers.push_back(state.shard.number);
        return numbers;
    }
    /// As arrays of jobs are named: "1,3-5".
    static std::string ranges(const std::vector<std::uint32_t>& numbers) {
        std::string text;
        for (std::size_t i = 0; i < numbers.size();) {
            std::size_t last = i;
            while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1)
                ++last;
            text += (text.empty() ? "" : ",") + std::to_string(numbers[i]) +
                    (last > i ? "-" + std::to_string(numbers[last]) : "");
            i = last + 1;
        }
        return text;
    }
    [[nodiscard]] std::vector<std::uint32_t> with_failures() const {
        std::vector<std::uint32_t> numbers;
        for (const auto& state : states_)
            if (state.failed > 0)
                numbers.push_back(state.shard.number);
        return numbers;
    }
    static std::string rest_of(bool too_long) { return too_long ? " --yes-really-long" : ""; }
    [[nodiscard]] std::string command(const std::vector<std::uint32_t>& numbers) const {
        const auto predicted = predicted_shards(scene_, files_.of);
        const std::string rest =
            rest_of(std::any_of(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
                return is_too_long(scene_, predicted[number - 1]);
            }));
        const std::string run = shard_command_line(name_, origin_.overrides, directory_);
        if (numbers.size() == 1)
            return fmt::format("{}{}/{}{}", run, numbers.front(), files_.of, rest);
        std::string list;
        for (const auto number : numbers)
            list += " " + std::to_string(number);
        return fmt::format("for I in{}; do {}$I/{}{}; done\n  (of an array of jobs: {})", list, run,
                           files_.of, rest, ranges(numbers));
    }

    std::string directory_;
    ShardFiles files_;
    WorkOrigin origin_;
    std::string name_; ///< of the scene
    Scene scene_;
    FinishedWork work_;
    std::vector<ShardState> states_;
};

int merge_command(const MergeOptions& options) {
    Merged merged(options);
    if (options.status) {
        write_standard_output(merged.status());
        return merged.complete() && !merged.has_failures() ? done : run_failed;
    }
    const bool complete = merged.complete();
    if (complete && !options.really_long) // otherwise it makes nothing
        require_short_enough(merged.scene(), predicted_merge(merged.scene()));
    std::optional<ReportDirectory> out;
    opened([&] { out.emplace(options.directory, merged.scene().report); });
    EndRequests end_requests([&] {
        out.reset();
        say_interrupted("interrupted in what could not be left in time; no report is written");
    });
    ProgressLine progress(!options.quiet);
    StudyResult result = run_study(merged.scene(), {.jobs = options.jobs,
                                                    .progress = &progress,
                                                    .finished = &merged.work(),
                                                    .only_finished = !complete});
    end_requests.settle();
    if (!complete)
        result.remarks.push_back("Part of the runs: " + merged.missing() + ".");
    const bool interrupted = !write_reports(*out, reported(result)) || result.interrupted();
    if (!options.quiet)
        write_standard_output(text_document(result_document(result)));
    if (!complete) {
        say(merged.missing() + "; the result holds what is there, and tvbeam merge --status says "
                               "what makes the rest");
        return run_failed;
    }
    if (interrupted || result.failed()) {
        say(interrupted ? "interrupted; the result holds what was finished"
                        : "a run failed; the result says which and why");
        return run_failed;
    }
    return done;
}

} // namespace

Command add_merge(CLI::App& app) {
    auto* merge = app.add_subcommand(
        "merge", "Put the shards of a scene together, and write what one run would have written.\n"
                 "Example: tvbeam merge out/stress --status");
    const auto options = std::make_shared<MergeOptions>();
    merge->add_option("directory", options->directory, "the one that run --shard kept them in")
        ->type_name("DIR")
        ->required();
    merge->add_flag("--status", options->status,
                    "only say what is done, missing and failed, by shard, and which command makes "
                    "what is missing; exit 3 where something is, or has failed");
    merge
        ->add_option("--scene", options->scene,
                     "the scene's file, where it does not stand any more where the shards read it")
        ->type_name("SCENE");
    merge->add_flag("--quiet", options->quiet, "no table, and no progress line");
    add_really_long(*merge, options->really_long);
    add_jobs(*merge, options->jobs);
    return {merge, [options] { return merge_command(*options); }};
}

} // namespace tvbeam
