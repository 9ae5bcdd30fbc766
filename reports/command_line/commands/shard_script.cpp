#include "mms/text/input_error.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/shared_options.hpp"
#include "reports/command_line/commands/shell_words.hpp"
#include "reports/files/output_file.hpp"
#include "studies/predicted_work.hpp"
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

/// Of the shard that asks for most, in whole minutes and MB: ten times the predicted time, which is
/// right within a factor of ten, and the predicted memory besides what any process takes.
struct Request {
    std::int64_t minutes = 0;
    std::int64_t megabytes = 0;
};

Request request_of(const Scene& scene, std::uint32_t shards) {
    const auto groups = work_groups(scene);
    const auto owners = dealt(groups, shards);
    std::vector<double> work(shards, 0.0);
    for (std::size_t group = 0; group < groups.size(); ++group)
        for (std::size_t i = 0; i < owners[group].size(); ++i)
            work[owners[group][i] - 1] += groups[group].work(i);
    double seconds = *std::max_element(work.begin(), work.end()) / steps_a_second;
    const PredictedWork predicted = predicted_work(scene);
    if (scene.solver) // a program's time is known by its time-out only
        seconds = predicted.at_most / static_cast<double>(shards);
    constexpr double margin = 10.0;
    constexpr double any_process = 200e6; // bytes
    const auto rounded_up = [](double value) {
        return static_cast<std::int64_t>(std::ceil(value));
    };
    return {rounded_up(margin * seconds / 60.0) + 1,
            rounded_up((any_process + 2.0 * predicted.bytes) / 1e6)};
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
std::string memory_line(std::int64_t megabytes) {
    const auto largest = memory_of_nodes();
    if (!largest || *largest >= megabytes)
        return fmt::format("#SBATCH --mem={}M", megabytes);
    if (*largest == 1)
        return fmt::format("# It is to take {} MB; this cluster counts no memory.", megabytes);
    throw InputError({},
                     fmt::format("a shard is to take {} MB, and no node of this cluster has more "
                                 "than {} MB",
                                 megabytes, *largest));
}

int script_command(const ScriptOptions& options) {
    if (options.slurm == options.parallel)
        throw InputError({},
                         "tvbeam shard-script writes for one scheduler: --slurm, or --parallel");
    const Scene scene = read_scene(options.scene, options.overrides);
    require_dealable(scene);
    const std::string out = options.out.empty() ? "out/" + scene.name : options.out;
    const Request request = request_of(scene, options.shards);
    const std::string run = shard_command_line(options.scene, options.overrides, out);
    const std::string merge = "tvbeam merge " + word(out);
    if (options.slurm)
        write_standard_output(fmt::format("#!/bin/sh\n"
                                          "#SBATCH --job-name={}\n"
                                          "#SBATCH --array=1-{}\n"
                                          "#SBATCH --cpus-per-task=1\n"
                                          "{}\n"
                                          "#SBATCH --time={}\n"
                                          "# Afterwards: {}\n"
                                          "exec {}auto/{} --quiet\n",
                                          word("tvbeam-" + scene.name), options.shards,
                                          memory_line(request.megabytes), request.minutes, merge,
                                          run, options.shards));
    else
        write_standard_output(fmt::format("#!/bin/sh\n"
                                          "# A job is to take at most {} minutes and {} MB.\n"
                                          "seq {} | parallel --memfree {}M {}{{}}/{} --quiet\n"
                                          "{}\n",
                                          request.minutes, request.megabytes, options.shards,
                                          request.megabytes, run, options.shards, merge));
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
