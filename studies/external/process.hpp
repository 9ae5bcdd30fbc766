#pragma once

#include "studies/external/keeper.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tvbeam {

/// A program to be run.
struct ProcessTask {
    std::filesystem::path program;      ///< absolute
    std::vector<std::string> arguments; ///< without the program's name
    std::filesystem::path directory;
    std::map<std::string, std::string> environment; ///< besides this process's own
    std::optional<double> timeout;                  ///< s
    /// Told of each line on standard output (OutputLines).
    std::function<void(const std::string&)> line;
    /// Asked a few times a second; false: the program is to be ended.
    std::function<bool()> go_on;
};

struct ProcessResult {
    bool interrupted = false; ///< go_on said so
    /// Why it is no success, as "exit 3", "killed by signal 9 (Killed)"; empty: exit 0.
    std::string failure;
    std::string last_lines;     ///< on standard error, or where there are none on standard output
    bool are_of_errors = false; ///< on standard error
    double seconds = 0.0;       ///< wall clock, from its beginning to the end
};

/// Runs a program in a process group of its own, without standard input, and reads what it writes
/// in bounded memory. Where it is to be ended, at the time-out say, its whole group gets SIGTERM,
/// and SIGKILL a second later; whatever of the group is left at the end of the program is killed.
/// Several threads may call at a time.
ProcessResult run_process(const ProcessTask& task, const Keeper& keeper);

} // namespace tvbeam
