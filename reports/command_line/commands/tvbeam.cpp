// The command line. Exit: 0 done, 1 an expectation failed, 2 bad input or usage, 3 a run failed.

#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/commands/refusal.hpp"
#include "reports/command_line/commands/said.hpp"
#include "reports/files/output_file.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

namespace {

using namespace tvbeam;

std::vector<std::string> names_of_commands(const CLI::App& app) {
    const auto all = app.get_subcommands([](const CLI::App*) { return true; });
    std::vector<std::string> commands;
    commands.reserve(all.size());
    for (const auto* command : all)
        commands.push_back(command->get_name());
    return commands;
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const auto* option : command.get_options())
        for (const auto& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

/// What is wrong with the words that the program was called with, and what to do.
std::string mistake_in(const CLI::App& app, const CLI::ParseError& error) {
    const auto called = app.get_subcommands();
    const CLI::App& command = called.empty() ? app : *called.front();
    const std::string name = called.empty() ? "tvbeam" : "tvbeam " + command.get_name();
    const std::string help = "; " + name + " --help lists them";
    auto words = command.remaining();
    const auto option = std::find_if(words.begin(), words.end(), [](const std::string& word) {
        return word.size() > 1 && word.starts_with('-');
    });
    if (option != words.end())
        return "'" + *option + "' is not an option of " + name +
               did_you_mean(option->substr(0, option->find('=')), options_of(command)) + help;
    if (!words.empty() && called.empty())
        return "'" + words[0] + "' is not a command" +
               did_you_mean(words[0], names_of_commands(app)) + help;
    if (!words.empty())
        return "'" + words[0] + "' is one word too many for " + name + "; see " + name + " --help";
    if (called.empty())
        return "a command is missing" + help;
    return std::string(error.what()) + "; see " + name + " --help";
}

/// Throws InputError for words that are none of its.
int called_command(CLI::App& app, const std::vector<Command>& commands, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) { // --help, --version
            std::ostringstream text;
            app.exit(error, text, text);
            write_standard_output(text.str());
            return done;
        }
        throw InputError({}, mistake_in(app, error));
    }
    const auto called = std::find_if(commands.begin(), commands.end(),
                                     [](const Command& one) { return one.app->parsed(); });
    return called->call();
}

int command_line(int argc, char** argv) {
    CLI::App app(
        "Verification and convergence studies for a thermoviscoelastic beam between two stops.\n"
        "Exit: 0 done, 1 an expectation failed, 2 bad input or usage, 3 a run failed.");
    app.name("tvbeam");
    app.set_version_flag("--version", "tvbeam " TVBEAM_VERSION);
    app.require_subcommand(1);
    const std::vector<Command> commands{add_run(app),    add_merge(app),     add_shard_script(app),
                                        add_check(app),  add_analyse(app),   add_compare(app),
                                        add_derive(app), add_new(app),       add_list(app),
                                        add_keys(app),   add_completion(app)};
    try {
        return called_command(app, commands, argc, argv);
    } catch (const InputError& error) {
        say(error.what());
        report_refusal(app, error.what());
        return bad_input;
    }
}

/// Words take memory, too.
void say_no_memory() {
    std::fputs("tvbeam: there is not enough memory\n", stderr);
}

/// Libraries run out of memory also where they say that they throw nothing. Those of C++ then do
/// not tell what was thrown.
[[noreturn]] void terminate_said() {
    try {
        if (const auto exception = std::current_exception())
            std::rethrow_exception(exception);
        std::fputs("tvbeam: cannot go on; is there enough memory?\n", stderr);
        std::_Exit(run_failed);
    } catch (const std::bad_alloc&) {
        say_no_memory();
        std::_Exit(run_failed);
    } catch (...) {
        std::abort();
    }
}

int reported_command_line(int argc, char** argv) {
    try {
        return command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const ClosedPipe&) {
        return run_failed; // who closes a pipe knows it
    } catch (const std::exception& error) {
        say(error.what());
        return run_failed;
    }
}

/// What the caller has closed the next file would get, and in it stood what is said. As if it were
/// still closed nothing can be read from it or written to it.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0) // open takes the lowest that is free
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

} // namespace

int main(int argc, char** argv) {
    occupy_closed_streams();
    // Vectors of large meshes come and go; their pages stay, as to clear new ones takes longer than
    // to compute with them.
    constexpr int keep = 1 << 30; // bytes
    mallopt(M_MMAP_THRESHOLD, keep);
    mallopt(M_TRIM_THRESHOLD, keep);
    // A closed pipe then fails the write, which is reported like any other.
    std::signal(SIGPIPE, SIG_IGN);
    // Who begins this program may ignore the ends of its own; of these it is asked how they ended.
    std::signal(SIGCHLD, SIG_DFL);
    std::set_terminate(&terminate_said);
    try {
        return reported_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        say_no_memory();
        return run_failed;
    }
}
