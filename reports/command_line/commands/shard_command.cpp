#include "reports/command_line/commands/shard_command.hpp"

#include "mms/text/input_error.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/destination.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/command_line/commands/shell_words.hpp"
#include "reports/command_line/end_requests.hpp"
#include "reports/command_line/progress_line.hpp"
#include "reports/files/output_file.hpp"
#include "reports/files/shard_files.hpp"
#include "studies/shards/run_shard.hpp"
#include "studies/study.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace tvbeam {

namespace {

constexpr std::uint32_t most_shards = 100'000;

/// A number from 1 to the most; 0 where the text is none.
std::uint32_t number_in(const std::string& text, std::uint32_t most) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value <= most ? value : 0;
}

Shard shard_in(const std::string& text) {
    const auto slash = text.find('/');
    const std::uint32_t of =
        slash == std::string::npos ? 0 : number_in(text.substr(slash + 1), most_shards);
    const Place place{"--shard " + text};
    if (of == 0)
        throw InputError(place, fmt::format("is no part of a whole; write I/N, such as 3/100, with "
                                            "1 <= I <= N <= {}",
                                            most_shards));
    const std::string first = text.substr(0, slash);
    if (first != "auto") {
        const Shard shard{number_in(first, of), of};
        if (shard.number == 0)
            throw InputError(place, fmt::format("has no part of 1 to {} before the /", of));
        return shard;
    }
    const char* task = std::getenv("SLURM_ARRAY_TASK_ID");
    const Shard shard{task == nullptr ? 0 : number_in(task, of), of};
    if (shard.number == 0)
        throw InputError(
            place, fmt::format("takes its part from SLURM_ARRAY_TASK_ID, which is {}; "
                               "it must be 1 to {}",
                               task == nullptr ? "not set" : "'" + std::string(task) + "'", of));
    return shard;
}

/// A file by its absolute path, so that a merge finds it from any directory.
std::string lasting_name(const Scene& scene, const std::string& given) {
    const bool is_path = given.find('/') != std::string::npos || given.ends_with(".toml");
    return is_path ? std::filesystem::absolute(scene.file).string() : given;
}

void make_directory(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
        throw OutputError("cannot make the directory '" + directory.string() + "'" +
                          (error ? ": " + error.message() : "; a file has its name"));
}

/// Ends a shard whose results cannot be kept: nothing else comes of it.
class WhileKept final : public Progress {
public:
    WhileKept(Progress& progress, const FinishedWork& work) : progress_(progress), work_(work) {}
    void expect(double work) override { progress_.expect(work); }
    bool advance(double work) override { return progress_.advance(work) && work_.keeps(); }

private:
    Progress& progress_;
    const FinishedWork& work_;
};

} // namespace

int shard_command(const ShardOptions& options) {
    const Shard shard = shard_in(options.shard);
    const Scene scene = read_scene(options.scene, options.overrides);
    require_dealable(scene);
    if (!options.really_long)
        require_short_enough(scene, predicted_shards(scene, shard.of)[shard.number - 1]);
    require_runnable(scene);
    FinishedWork work(scene, {lasting_name(scene, options.scene), options.overrides, shard});
    const std::filesystem::path file = shard_file(options.out, shard);
    const TornLines torn = opened([&] {
        make_directory(options.out);
        work.keep_in(file);
        return std::filesystem::exists(file) ? work.read(file) : TornLines();
    });
    if (!options.quiet && (work.found() > 0 || torn.count > 0))
        say(fmt::format("shard {} goes on with {} finished runs from {}{}", shard.name(),
                        work.found(), file.string(), torn.count == 0 ? "" : "; " + torn.text()));
    EndRequests end_requests([&] {
        say_interrupted("interrupted in what could not be left in time; the same command goes on "
                        "from the runs that are kept");
    });
    ProgressLine progress(!options.quiet);
    WhileKept while_kept(progress, work);
    const ShardEnd end =
        run_shard(scene, shard, {.jobs = options.jobs, .progress = &while_kept, .finished = &work});
    end_requests.settle();
    work.write();
    if (!work.failure().empty()) {
        say(work.failure() + "; the shard ends here, and goes on when it is started again");
        return run_failed;
    }
    if (end.missing > 0) {
        say(fmt::format("interrupted: {} of {} runs are not made; the same command goes on",
                        end.missing, end.there + end.missing));
        return run_failed;
    }
    if (end.failed > 0)
        say(fmt::format("{} of the runs of shard {} failed; tvbeam merge says which and why",
                        end.failed, shard.name()));
    else if (!options.quiet && end.there == 0)
        say(fmt::format("shard {} is dealt no run: there are fewer runs than shards",
                        shard.name()));
    else if (!options.quiet)
        say(fmt::format("shard {} has all of its {} runs in {}; when the others have theirs: "
                        "tvbeam merge {}",
                        shard.name(), end.there, file.string(), word(options.out)));
    return end.failed > 0 ? run_failed : done;
}

} // namespace tvbeam
