#include "reports/command_line/completion.hpp"

#include <CLI/CLI.hpp>
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

} // namespace

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

} // namespace tvbeam
