#include "studies/gates/command_expectation.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/external/process.hpp"
#include "studies/text/column_sizes.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/crc.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tvbeam {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_commands = 100;
constexpr double longest_command = 60.0;     // s
constexpr std::size_t most_said = 1 << 24;   // bytes; what comes behind is passed over
constexpr std::size_t most_examined = 16384; // of a longer text, its checksum

/// Set for a command of a scene: the scenes that it checks run no commands of theirs.
constexpr const char* within_a_command = "TVBEAM_WITHIN_A_COMMAND";

struct AskedCommand {
    std::vector<std::string> words;
    std::map<std::string, std::string> files; ///< their texts by their names
    std::int64_t exit = 0;
    std::vector<std::string> says;
    std::string what;
    Place place_of_exit;
    Place place_of_says;
};

struct Ended {
    std::string exit; ///< as "exit 0", or what else became of it
    std::string said;
};

/// Of tables whose heading ends with the seconds the rows without their last word, and of other
/// lines what comes before seconds at their end.
std::string without_seconds(const std::string& line, bool& in_table) {
    if (line.empty())
        in_table = false;
    const std::string kept = boost::algorithm::trim_right_copy(line);
    if (in_table)
        return boost::algorithm::trim_right_copy(kept.substr(0, kept.rfind(' ') + 1));
    in_table = kept.ends_with(" sec");
    static const std::regex seconds(", [0-9.]+ s$");
    return std::regex_replace(kept, seconds, "");
}

Ended run(const AskedCommand& command, const std::string& program, const Keeper& keeper) {
    for (const auto& [name, text] : command.files) {
        const fs::path file = keeper.directory() / name;
        std::error_code error;
        fs::create_directories(file.parent_path(), error);
        if (error || !(std::ofstream(file, std::ios::binary) << text << std::flush))
            return {"nothing run: cannot write " + name, ""};
    }
    // The shell makes one of the two streams.
    ProcessTask task{.program = "/bin/sh",
                     .arguments = {"-c", R"(exec "$0" "$@" 2>&1)", program},
                     .directory = keeper.directory(),
                     .environment = {{within_a_command, "1"}, {"GITHUB_STEP_SUMMARY", ""}},
                     .timeout = longest_command,
                     .line = {},
                     .go_on = [] { return true; }};
    // What is named from where this program runs is elsewhere from there.
    if (const char* data = std::getenv("TVBEAM_DATA"); data != nullptr && *data != '\0')
        task.environment["TVBEAM_DATA"] = fs::absolute(data).string();
    task.arguments.insert(task.arguments.end(), command.words.begin(), command.words.end());
    Ended ended;
    bool in_table = false;
    task.line = [&](const std::string& line) {
        if (ended.said.size() < most_said)
            ended.said += without_seconds(line, in_table) + "\n";
    };
    const ProcessResult result = run_process(task, keeper);
    ended.exit = result.failure.empty() ? "exit 0" : result.failure;
    return ended;
}

/// The files of a directory by their names, each with how many lines it has, and how large the
/// numbers of data are.
std::string files_in(const fs::path& directory) {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        if (!entry.is_regular_file())
            continue;
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string text(std::istreambuf_iterator<char>(file), {});
        const auto lines = std::ranges::count(text, '\n');
        const std::string kind = entry.path().extension().string();
        const std::string name = entry.path().lexically_relative(directory).string();
        // Pictures are as long as what draws them makes them, and so are notes for --resume.
        const bool is_text = kind == ".csv" || kind == ".toml" || kind == ".py" || kind == ".md";
        const std::string sizes = kind == ".csv" || kind == ".dat" ? column_sizes(text) : "";
        files.insert((is_text ? fmt::format("{}: {} lines", name, lines) : name) +
                     (sizes.empty() ? "" : "," + sizes));
    }
    return boost::algorithm::join(files, "\n");
}

std::string examined(const std::string& text) {
    if (text.size() <= most_examined)
        return text;
    boost::crc_32_type sum;
    sum.process_bytes(text.data(), text.size());
    return fmt::format("{:08x} of {} bytes\n", sum.checksum(), text.size());
}

/// Where lines break depends on the words before.
std::string in_one_line(const std::string& text) {
    std::string line;
    for (const char c : text) {
        const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (!is_blank || !line.ends_with(' '))
            line += is_blank ? ' ' : c;
    }
    return line;
}

void add_checks(const AskedCommand& command, const Ended& ended, const std::string& files,
                std::vector<CheckedExpectation>& checked) {
    const std::string wanted = "exit " + std::to_string(command.exit);
    checked.push_back({.what = command.what,
                       .expected = wanted,
                       .found = ended.exit + ": " + beginning_of(ended.said),
                       .place = command.place_of_exit,
                       .holds = ended.exit == wanted,
                       .examined = ended.exit + "\n" + examined(ended.said) + files});
    const std::string said = in_one_line(ended.said);
    for (const auto& words : command.says)
        checked.push_back({.what = command.what + ".says",
                           .expected = "\"" + words + "\"",
                           .found = beginning_of(ended.said),
                           .place = command.place_of_says,
                           .holds = said.find(in_one_line(words)) != std::string::npos});
}

AskedCommand read_asked_command(TableReader& table) {
    AskedCommand command{.words = table.texts("run").value_or(std::vector<std::string>()),
                         .files = {},
                         .exit = table.integer("exit").value_or(0),
                         .says = table.texts("says").value_or(std::vector<std::string>()),
                         .what = what_of(table, ""),
                         .place_of_exit = table.place("run"),
                         .place_of_says = table.place("says")};
    constexpr std::int64_t greatest_exit = 255;
    if (command.exit < 0 || command.exit > greatest_exit)
        throw table.error("exit", " is " + std::to_string(command.exit) +
                                      "; a command ends with a code from 0 to 255");
    if (command.words.empty())
        throw table.error("run", " must be the words that follow tvbeam");
    for (std::size_t i = 0; i < command.says.size(); ++i)
        if (std::ranges::none_of(command.says[i],
                                 [](unsigned char letter) { return std::isalnum(letter); }))
            throw table.error("says", " must hold words of what is said", i);
    if (auto files = table.table("files"))
        for (const auto& name : files->unread()) {
            const auto within = fs::path(name).lexically_normal();
            if (!within.has_filename() || within.is_absolute() || within == "." ||
                *within.begin() == "..")
                throw table.error("files",
                                  " names '" + name + "', which is no file within the directory");
            command.files[name] = files->text(name).value_or("");
        }
    table.finish();
    return command;
}

} // namespace

void expect_commands(TableReader& expect, const std::string& program,
                     std::vector<Expectation>& expectations) {
    auto tables = expect.tables("commands");
    if (tables.empty())
        return;
    if (tables.size() > most_commands)
        throw expect.error("commands", " has " + std::to_string(tables.size()) +
                                           " of them; at most " + std::to_string(most_commands) +
                                           " are run");
    std::vector<AskedCommand> commands;
    commands.reserve(tables.size());
    for (auto& table : tables)
        commands.push_back(read_asked_command(table));
    expectations.push_back([commands, program](const StudyResult& /*result*/) {
        std::vector<CheckedExpectation> checked;
        const auto none_is_run = [&](const std::string& why) {
            add_checks(commands.front(), {"nothing: " + why, ""}, "", checked);
        };
        if (std::getenv(within_a_command) != nullptr)
            none_is_run("a command of another scene checks this one");
        else if (program.empty())
            none_is_run("no program is known to run");
        else
            try {
                const Keeper keeper;
                for (const auto& command : commands) {
                    const Ended ended = run(command, program, keeper);
                    add_checks(command, ended, files_in(keeper.directory()), checked);
                }
            } catch (const std::system_error& error) { // no directory, no process
                none_is_run(error.what());
            }
        return checked;
    });
}

} // namespace tvbeam
