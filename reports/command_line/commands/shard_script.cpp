#include "mms/text/input_error.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/commands/shell_words.hpp"
#include "reports/files/output_file.hpp"
#include "studies/shards/shard.hpp"
#include "studies/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

struct ScriptOptions {
    std::string scene;
    std::uint32_t shards = 1;
    std::vector<std::string> overrides;
    std::string out;
    bool slurm = false;
    bool parallel = false;
};

/// Of the shard that asks for most; none: nobody knows what a program takes.
struct Request {
    std::optional<std::int64_t> minutes;
    std::optional<std::int64_t> megabytes;
    bool really_long = false; ///< a shard is refused without --yes-really-long
};

/// Ten times the predicted time, which is right within a factor of ten; of a program as long as its
/// time-out allows. The predicted memory besides what any process takes.
Request request_of(const Scene& scene, std::uint32_t shards) {
    const auto all = predicted_shards(scene, shards);
    const PredictedWork& predicted = *std::max_element(
        all.begin(), all.end(), [](const PredictedWork& a, const PredictedWork& b) {
            return std::max(a.seconds, a.at_most) < std::max(b.seconds, b.at_most);
        });
    constexpr double margin = 10.0;
    constexpr double any_process = 200e6; // bytes
    const double most = 1e9;              // minutes, MB: beyond any scheduler
    const auto rounded_up = [most](double value) {
        return static_cast<std::int64_t>(std::ceil(std::min(value, most)));
    };
    const double seconds = scene.solver ? predicted.at_most : margin * predicted.seconds;
    Request request{.minutes = rounded_up(seconds / 60.0) + 1,
                    .megabytes = rounded_up((any_process + 2.0 * predicted.bytes) / 1e6),
                    .really_long = is_too_long(scene, predicted)};
    if (scene.solver)
        request.megabytes.reset();
    if (scene.solver && !scene.solver->timeout)
        request.minutes.reset();
    return request;
}

std::string time_line(const Request& request) {
    return request.minutes ? fmt::format("#SBATCH --time={}", *request.minutes)
                           : "# How long the program takes is not known: [solver] has no "
                             "timeout; a line #SBATCH --time=MINUTES says it here.";
}

/// What stands in a comment has one line.
void require_one_line(const std::string& text) {
    if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }))
        throw InputError({}, "a name with a control character cannot stand in a script");
}

/// What the largest node of this machine's Slurm cluster has, in MB, as its administrators say;
/// none where no cluster answers. One that does not count memory says 1, and refuses who asks for
/// more.
std::optional<std::int64_t> memory_of_nodes() {
    const std::unique_ptr<FILE, decltype(&pclose)> sinfo(
        popen("sinfo --noheader --format=%m 2>/dev/null", "r"), &pclose);
    std::optional<std::int64_t> largest;
    std::array<char, 64> line{};
    while (sinfo && std::fgets(line.data(), line.size(), sinfo.get()) != nullptr)
        if (const long long megabytes = std::atoll(line.data()); megabytes > 0)
            largest = std::max<std::int64_t>(largest.value_or(0), megabytes);
    return largest;
}

/// The line that asks for memory, or why it is none.
std::string memory_line(const Request& request) {
    if (!request.megabytes)
        return "# What memory the program takes is not known; a line #SBATCH --mem=NUMBERM says it "
               "here, in MB.";
    const auto largest = memory_of_nodes();
    if (!largest || *largest >= *request.megabytes)
        return fmt::format("#SBATCH --mem={}M", *request.megabytes);
    if (*largest == 1)
        return fmt::format("# It is to take {} MB; this cluster counts no memory.",
                           *request.megabytes);
    throw InputError({},
                     fmt::format("a shard is to take {} MB, and no node of this cluster has more "
                                 "than {} MB",
                                 *request.megabytes, *largest));
}

/// "Each job takes up to 201 MB and 5 minutes."
std::string words_of(const Request& request) {
    std::vector<std::string> known;
    if (request.megabytes)
        known.push_back(fmt::format("{} MB", *request.megabytes));
    if (request.minutes)
        known.push_back(fmt::format("{} minutes", *request.minutes));
    std::string words;
    if (!known.empty())
        words = fmt::format("Each job takes up to {}.", fmt::join(known, " and "));
    if (!request.megabytes)
        words += fmt::format("{}What memory the program takes is not known; --memfree NUMBERM "
                             "waits for so much.",
                             words.empty() ? "" : " ");
    return words;
}

int script_command(const ScriptOptions& options) {
    if (options.slurm == options.parallel)
        throw InputError({},
                         "tvbeam shard-script writes for one scheduler: --slurm, or --parallel");
    const Scene scene = read_scene(options.scene, options.overrides);
    require_dealable(scene);
    const std::string out = options.out.empty() ? "out/" + scene.name : options.out;
    require_one_line(out + options.scene);
    const Request request = request_of(scene, options.shards);
    const std::string run = shard_command_line(options.scene, options.overrides, out);
    const std::string rest = request.really_long ? " --quiet --yes-really-long" : " --quiet";
    const std::string merge =
        "tvbeam merge " + word(out) +
        (is_too_long(scene, predicted_merge(scene)) ? " --yes-really-long" : "");
    if (options.slurm)
        write_standard_output(
            fmt::format("#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --array=1-{}\n#SBATCH "
                        "--cpus-per-task=1\n{}\n{}\n# Afterwards: {}\nexec {}auto/{}{}\n",
                        word("tvbeam-" + scene.name), options.shards, memory_line(request),
                        time_line(request), merge, run, options.shards, rest));
    else
        write_standard_output(
            fmt::format("#!/bin/sh\n# {}\nseq {} | parallel -q {}{}{{}}/{}{}\n{}\n",
                        words_of(request), options.shards,
                        request.megabytes ? fmt::format("--memfree {}M ", *request.megabytes) : "",
                        run, options.shards, rest, merge));
    return done;
}

} // namespace

Command add_shard_script(CLI::App& app) {
    auto* script = app.add_subcommand(
        "shard-script", "Print a script that makes a scene in N shards: an array of jobs that asks "
                        "for the time and memory that they are predicted to take.\n"
                        "Example: tvbeam shard-script stress-beam 8 --slurm > job.sh");
    const auto options = std::make_shared<ScriptOptions>();
    script->add_option("scene", options->scene, "a shipped scene, or a file")->required();
    constexpr int most = 100'000;
    script->add_option("shards", options->shards, "how many; schedulers allow about a thousand")
        ->type_name("N")
        ->check(CLI::Range(1, most))
        ->required();
    script->add_flag("--slurm", options->slurm, "an array of jobs for sbatch");
    script->add_flag("--parallel", options->parallel, "a line for GNU parallel, on one machine");
    add_overrides(*script, options->overrides, "override a key, as for run");
    add_directory(*script, options->out, "directory of the shards; without it out/SCENE");
    return {script, [options] { return script_command(*options); }};
}

} // namespace tvbeam
