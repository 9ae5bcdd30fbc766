#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace tvbeam {

/// What the program ends with: bad input means that nothing ran and nothing was written but what
/// was wrong (refusal.hpp).
enum Exit { done = 0, violated = 1, bad_input = 2, run_failed = 3 };

/// A command of the program, and what it does when it is called: its exit.
struct Command {
    CLI::App* app;
    std::function<int()> call;
};

// Each adds its command, with what it takes, to the program; a file each.
Command add_run(CLI::App& app);
Command add_merge(CLI::App& app);
Command add_shard_script(CLI::App& app);
Command add_check(CLI::App& app);
Command add_analyse(CLI::App& app);
Command add_compare(CLI::App& app);
Command add_derive(CLI::App& app);
Command add_new(CLI::App& app);
Command add_list(CLI::App& app);
Command add_keys(CLI::App& app);
Command add_completion(CLI::App& app);

} // namespace tvbeam
