#pragma once

#include "reports/files/finished_work.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tvbeam {

/// Of a shard, in the directory of a scene's results: shard-3-of-100.jsonl.
std::filesystem::path shard_file(const std::filesystem::path& directory, const Shard& shard);

/// The files of shards that a directory holds, by number. Throws InputError where it is none, where
/// it has none of them, and where they are not parts of the same number of shards.
struct ShardFiles {
    std::uint32_t of = 0;
    std::vector<std::pair<Shard, std::filesystem::path>> files;
};
ShardFiles shard_files_in(const std::filesystem::path& directory);

/// What a shard has done of what it was dealt.
struct ShardState {
    Shard shard;
    std::size_t dealt = 0;
    std::size_t done = 0;   ///< those that failed included
    std::size_t failed = 0; ///< runs that failed, cases that a check failed
};

/// Of every shard. work: that has read all files.
std::vector<ShardState> shard_states(const FinishedWork& work, std::uint32_t shards);

} // namespace tvbeam
