#pragma once

#include <string>
#include <vector>

namespace tvbeam {

/// As a shell reads it as one word: quoted where it has to be.
std::string word(const std::string& text);

/// "tvbeam run SCENE --set … --out DIR --shard ", which wants the shard.
std::string shard_command_line(const std::string& scene, const std::vector<std::string>& overrides,
                               const std::string& directory);

} // namespace tvbeam
