#include "reports/files/shard_files.hpp"

#include "mms/text/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <system_error>

namespace tvbeam {

std::filesystem::path shard_file(const std::filesystem::path& directory, const Shard& shard) {
    return directory / fmt::format("shard-{}-of-{}.jsonl", shard.number, shard.of);
}

ShardFiles shard_files_in(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::directory_iterator entries(directory, error);
    const Place place{directory.string()};
    if (error)
        throw InputError(place, "cannot be read: " + error.message() +
                                    "; name the directory that shards were given with --out");
    static const std::regex pattern(R"(shard-([1-9][0-9]{0,5})-of-([1-9][0-9]{0,5})\.jsonl)");
    ShardFiles all;
    for (const auto& entry : entries) {
        const std::string name = entry.path().filename().string();
        std::smatch match;
        constexpr std::size_t longest_name = 64;
        if (name.size() > longest_name || !std::regex_match(name, match, pattern))
            continue;
        const Shard shard{static_cast<std::uint32_t>(std::stoul(match[1])),
                          static_cast<std::uint32_t>(std::stoul(match[2]))};
        if (all.of != 0 && all.of != shard.of)
            throw InputError(place,
                             fmt::format("holds parts of {} and parts of {} shards, which were "
                                         "dealt differently; move one kind away",
                                         std::min(all.of, shard.of), std::max(all.of, shard.of)));
        all.of = shard.of;
        all.files.emplace_back(shard, entry.path());
    }
    if (all.files.empty())
        throw InputError(place,
                         "holds no shards; tvbeam run SCENE --out DIR --shard I/N makes one");
    std::sort(all.files.begin(), all.files.end(),
              [](const auto& a, const auto& b) { return a.first.number < b.first.number; });
    return all;
}

std::vector<ShardState> shard_states(const FinishedWork& work, std::uint32_t shards) {
    std::vector<ShardState> states;
    for (std::uint32_t number = 1; number <= shards; ++number)
        states.push_back({.shard = {number, shards}});
    const auto owners = dealt(work.groups(), shards);
    for (std::size_t group = 0; group < owners.size(); ++group)
        for (std::size_t index = 0; index < owners[group].size(); ++index) {
            ShardState& state = states[owners[group][index] - 1];
            ++state.dealt;
            state.done += work.has(group, index) ? 1 : 0;
            state.failed += work.failed(group, index) ? 1 : 0;
        }
    return states;
}

} // namespace tvbeam
