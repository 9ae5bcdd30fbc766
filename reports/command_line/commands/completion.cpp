#include "reports/command_line/commands/command.hpp"
#include "reports/files/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tvbeam {

namespace {

/// Whether a command wants the name of something that there is; `new` wants one that there is not.
bool takes_a_name(const CLI::App& command) {
    if (command.get_name() == "new")
        return false;
    const auto options = command.get_options();
    return std::any_of(options.begin(), options.end(), [](const CLI::Option* option) {
        return option->get_positional() && option->get_name(true) != "file";
    });
}

std::string words_of(const CLI::App& command) {
    std::string words;
    for (const CLI::Option* option : command.get_options())
        for (const auto& name : option->get_lnames())
            words += (words.empty() ? "--" : " --") + name;
    return words;
}

/// A script by which bash completes the commands and options of the program, and, where a command
/// takes a scene, the names that `tvbeam list --names` prints. zsh reads it after
/// `autoload -U +X bashcompinit && bashcompinit`.
std::string completion_script(const CLI::App& app) {
    std::string commands;
    std::string cases;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands += (commands.empty() ? "" : " ") + command->get_name();
        cases += fmt::format(
            "        {}) words=\"{}\"{} ;;\n", command->get_name(), words_of(*command),
            takes_a_name(*command)
                ? "; [[ $word == -* ]] || words+=\" $(tvbeam list --names 2>/dev/null)\""
                : "");
    }
    return fmt::format(R"(# bash completion of tvbeam; made by `tvbeam completion`
_tvbeam() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" words
    if [ "$COMP_CWORD" -eq 1 ]; then
        words="{} {}"
    else
        case "${{COMP_WORDS[1]}}" in
{}        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    [[ $word == -* ]] || COMPREPLY+=($(compgen -f -- "$word"))
}}
complete -o filenames -F _tvbeam tvbeam
)",
                       commands, words_of(app), cases);
}

} // namespace

Command add_completion(CLI::App& app) {
    auto* completion = app.add_subcommand(
        "completion", "Print a script by which bash (and zsh, after bashcompinit) completes "
                      "commands, options and names.\n"
                      "Example: source <(tvbeam completion)");
    return {completion, [&app] {
                write_standard_output(completion_script(app));
                return done;
            }};
}

} // namespace tvbeam
