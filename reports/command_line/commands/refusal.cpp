#include "reports/command_line/commands/refusal.hpp"

#include "reports/command_line/commands/said.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace tvbeam {

namespace {

namespace fs = std::filesystem;

/// What an option of a command names; empty: nothing, as it was not given or not read any more.
std::string named_by(const CLI::App& command, const std::string& option) {
    const auto* const found = command.get_option_no_throw(option);
    return found == nullptr || found->results().empty() ? std::string() : found->results().back();
}

/// Whether a report there takes the place of nothing else: standard output, a device, a file that
/// is not there, is empty or holds a report.
bool has_room_for_junit(const std::string& file) {
    std::error_code error;
    if (file == "-" || !fs::is_regular_file(file, error) || fs::file_size(file, error) == 0)
        return true;
    constexpr std::size_t head = 200; // bytes, before which <testsuites> stands
    std::string text(head, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), head);
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text.starts_with("<?xml") && text.find("<testsuites") != std::string::npos;
}

/// In a place that two reports are asked for nobody looks for this one.
bool is_asked_twice(const CLI::App& command, const std::string& junit) {
    return std::ranges::any_of(std::array{"--json", "--csv", "--record"}, [&](const char* option) {
        return same_place(named_by(command, option), junit);
    });
}

bool holds_something(const std::string& name) {
    std::error_code error;
    return fs::is_regular_file(name, error) ||
           (fs::is_directory(name, error) && !fs::is_empty(name, error));
}

} // namespace

void report_refusal(const CLI::App& program, const std::string& message) {
    for (const auto* command : program.get_subcommands()) {
        const std::string junit = named_by(*command, "--junit");
        if (!junit.empty() && !is_asked_twice(*command, junit) && has_room_for_junit(junit))
            try {
                destination(junit).write(
                    junit_report({{"tvbeam " + command->get_name(), 0.0, message, {}}}));
            } catch (const std::exception& error) {
                if (error.what() != message)
                    say(error.what());
            }
        for (const char* option : {"--json", "--csv", "--out"})
            if (const std::string name = named_by(*command, option);
                holds_something(name) && message.find(name) == std::string::npos)
                say("'" + name + "' is left as it was before this call");
    }
}

void write_with_junit(Destination& junit, const std::string& command,
                      std::vector<CheckedScene> checked, const std::function<void()>& others) {
    const auto write = [&] {
        if (junit.wanted())
            junit.write(junit_report(checked));
    };
    try {
        others();
    } catch (const OutputError& error) {
        checked.push_back({"tvbeam " + command, 0.0, error.what(), {}});
        write();
        throw;
    }
    write();
}

} // namespace tvbeam
