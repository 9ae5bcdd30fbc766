#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// What `run --shard` was called with.
struct ShardOptions {
    std::string scene;
    std::vector<std::string> overrides;
    std::string shard; ///< "3/100", "auto/100"
    std::string out;
    bool quiet = false;
    bool really_long = false;
    int jobs = 1;
};

/// Makes one part of a scene's runs and cases, or the rest of it. Returns the exit code; throws
/// InputError.
int shard_command(const ShardOptions& options);

} // namespace tvbeam
