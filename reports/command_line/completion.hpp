#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tvbeam {

/// A script by which bash completes the commands and options of the program, and, where a command
/// takes a scene, the names that `tvbeam list --names` prints. zsh reads it after
/// `autoload -U +X bashcompinit && bashcompinit`.
std::string completion_script(const CLI::App& app);

} // namespace tvbeam
