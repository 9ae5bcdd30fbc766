#include "reports/command_line/commands/command.hpp"
#include "reports/files/output_file.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

/// That --help has, too.
bool stands_in_help(const CLI::Option* option) {
    return !option->get_group().empty();
}

/// What prints the names that a command takes; empty: it takes none of something that there is.
std::string names_for(const CLI::App& command) {
    const std::string& name = command.get_name();
    if (name == "run" || name == "check" || name == "shard-script")
        return "tvbeam list --names scenes";
    if (name == "derive")
        return "tvbeam list --names derive";
    return name == "list" ? "tvbeam list --names all" : "";
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> words;
    for (const CLI::Option* option : command.get_options(stands_in_help))
        for (const auto& name : option->get_lnames())
            words.push_back("--" + name);
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, " "));
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const auto* command : commands_of(app))
        names.push_back(command->get_name());
    return joined(names);
}

bool has_option(const CLI::App& command, const std::string& option) {
    const auto options = options_of(command);
    return std::find(options.begin(), options.end(), option) != options.end();
}

/// Files are completed by bash itself, also those with blanks in their names.
std::string bash_script(const CLI::App& app) {
    std::string cases;
    for (const CLI::App* command : commands_of(app)) {
        const std::string names = names_for(*command);
        cases += fmt::format(
            "        {}) words=\"{}\"{} ;;\n", command->get_name(), joined(options_of(*command)),
            names.empty()
                ? ""
                : fmt::format("; [[ $word == -* ]] || words+=\" $({} 2>/dev/null)\"", names));
    }
    return fmt::format(R"sh(# bash completion of tvbeam; made by `tvbeam completion bash`
_tvbeam() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" words IFS
    if [ "$COMP_CWORD" -eq 1 ]; then
        words="{} {}"
    elif [ "$before" = --set ]; then
        words="$(tvbeam keys --as names 2>/dev/null)"
        compopt -o nospace
    else
        case "${{COMP_WORDS[1]}}" in
{}        esac
    fi
    IFS=$' \n' read -r -d '' -a words <<<"$words"
    IFS=$'\n'
    COMPREPLY=($(compgen -W "${{words[*]}}" -- "$word"))
    [ "$before" = --set ] && COMPREPLY=("${{COMPREPLY[@]/%/=}}") && return
    [[ $word == -* ]] || COMPREPLY+=($(compgen -f -- "$word"))
}}
complete -o filenames -F _tvbeam tvbeam
)sh",
                       command_names(app), joined(options_of(app)), cases);
}

/// In single quotes, as zsh and fish take it.
std::string quoted(std::string text, const std::string& quote) {
    boost::algorithm::replace_all(text, "'", quote);
    boost::algorithm::replace_all(text, "\n", " ");
    return "'" + text + "'";
}

std::string zsh_script(const CLI::App& app) {
    std::string cases;
    for (const CLI::App* command : commands_of(app)) {
        const std::string names = names_for(*command);
        cases += fmt::format(
            "        {}) options=({}){} ;;\n", command->get_name(), joined(options_of(*command)),
            names.empty() ? "" : fmt::format("; names=(${{(f)\"$({})\"}})", names));
    }
    return fmt::format(R"sh(#compdef tvbeam
# zsh completion of tvbeam; made by `tvbeam completion zsh`
_tvbeam() {{
    local -a options names
    if (( CURRENT == 2 )); then
        compadd -- {} {}
        return
    fi
    if [[ ${{words[CURRENT-1]}} == --set ]]; then
        names=(${{(f)"$(tvbeam keys --as names)"}})
        compadd -S = -- $names
        return
    fi
    case ${{words[2]}} in
{}    esac
    if [[ ${{words[CURRENT]}} == -* ]]; then
        compadd -- $options
    else
        compadd -- $names
        _files
    fi
}}
_tvbeam "$@"
)sh",
                       command_names(app), joined(options_of(app)), cases);
}

std::string fish_script(const CLI::App& app) {
    std::string lines = "# fish completion of tvbeam; made by `tvbeam completion fish`\n";
    for (const CLI::App* command : commands_of(app)) {
        const std::string name = command->get_name();
        const std::string description = command->get_description();
        lines += fmt::format("complete -c tvbeam -n __fish_use_subcommand -f -a {} -d {}\n", name,
                             quoted(description.substr(0, description.find('\n')), "\\'"));
        const std::string seen = fmt::format("-n '__fish_seen_subcommand_from {}'", name);
        for (const CLI::Option* option : command->get_options(stands_in_help))
            for (const auto& word : option->get_lnames())
                lines += fmt::format("complete -c tvbeam {} -l {}{} -d {}\n", seen, word,
                                     option->get_items_expected_max() > 0 ? " -r" : "",
                                     quoted(option->get_description(), "\\'"));
        if (const std::string names = names_for(*command); !names.empty())
            lines += fmt::format("complete -c tvbeam {} -a '({})'\n", seen, names);
        if (has_option(*command, "--set"))
            lines += fmt::format("complete -c tvbeam {} -x -l set -a '(tvbeam keys --as "
                                 "names)='\n",
                                 seen);
    }
    return lines;
}

} // namespace

Command add_completion(CLI::App& app) {
    auto* completion = app.add_subcommand(
        "completion", "Print a script by which a shell completes commands, options, names and the "
                      "keys of --set.\n"
                      "Example: source <(tvbeam completion bash)");
    const auto shell = std::make_shared<std::string>("bash");
    completion->add_option("shell", *shell, "bash, zsh or fish")
        ->check(CLI::IsMember({"bash", "zsh", "fish"}))
        ->type_name("SHELL")
        ->capture_default_str();
    return {completion, [&app, shell] {
                write_standard_output(*shell == "zsh"    ? zsh_script(app)
                                      : *shell == "fish" ? fish_script(app)
                                                         : bash_script(app));
                return done;
            }};
}

} // namespace tvbeam
