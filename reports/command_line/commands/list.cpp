#include "mms/equations/equation_system.hpp"
#include "mms/text/file_text.hpp"
#include "mms/text/input_error.hpp"
#include "mms/text/nearest_name.hpp"
#include "mms/text/visible_text.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/command_line/progress_line.hpp"
#include "reports/document/text_table.hpp"
#include "reports/files/build_ids.hpp"
#include "reports/files/output_file.hpp"
#include "studies/evolution/evolution.hpp"
#include "studies/gates/features.hpp"
#include "studies/predicted_work.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/sensitivity/sensitivity.hpp"
#include "studies/stress/stress_block.hpp"
#include "studies/study.hpp"
#include "studies/work_precision/work_precision_block.hpp"

#include <fmt/ranges.h>

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

constexpr std::size_t largest_shipped = 1 << 20; // bytes

bool has_solution(const Scene& scene) {
    return !scene.solver && scene.poses_problem() && scene.has_exact_solution();
}

/// What --names lists: all, or those that a command takes.
enum class Names { all, scenes, derived };

int names_command(Names wanted) {
    std::string text;
    for (const auto& file : shipped_files(Shipped::scene))
        if (wanted != Names::derived ||
            has_solution(read_scene(file.path.string(), {}, {.unrun = true})))
            text += file.name + "\n";
    if (wanted != Names::scenes)
        for (const auto kind : {Shipped::solution, Shipped::equations})
            for (const auto& file : shipped_files(kind))
                text += file.name + "\n";
    write_standard_output(text);
    return done;
}

/// The groups that scenes are listed in, by what is new in them.
constexpr std::array groups{"Errors against an exact solution",
                            "Errors against a finer run",
                            "Error against run time",
                            "One run over time",
                            "Stiff and extreme",
                            "Deliberate defects",
                            "Programs of your own",
                            "Gates of what the program itself says and refuses"};

/// The place of a scene's group.
std::size_t group_of(const Scene& scene) {
    if (scene.is_gate)
        return 7;
    if (scene.solver)
        return 6;
    if (scene.get<SensitivityBlock>() != nullptr || scene.defect)
        return 5;
    if (scene.get<StressBlock>() != nullptr)
        return 4;
    if (scene.get<EvolutionBlock>() != nullptr)
        return 3;
    if (scene.get<WorkPrecisionBlock>() != nullptr)
        return 2;
    return scene.reference ? 1 : 0;
}

/// What it costs on one core, to two digits.
std::string cost_of(const Scene& scene) {
    if (scene.solver)
        return "?";
    const double seconds = predicted_work(scene).seconds;
    return seconds < 0.1 ? "< 0.1 s" : duration_text(seconds);
}

struct Line {
    std::string name;
    std::string cost;
    std::string words;
};

std::string aligned(const std::vector<Line>& lines) {
    std::size_t widest = 0;
    for (const auto& line : lines)
        widest = std::max(widest, line.name.size());
    std::string text;
    for (const auto& [name, cost, words] : lines) {
        std::string begin = fmt::format("  {:<{}}  {:>9}  ", name, widest, cost);
        constexpr std::size_t page = 80;
        constexpr std::size_t narrowest = 30;
        std::istringstream rest(
            wrapped(words, 0, std::max(narrowest, page - std::min(page, begin.size()))));
        for (std::string line; std::getline(rest, line);) {
            text.append(begin).append(line).append("\n");
            begin.assign(begin.size(), ' ');
        }
    }
    return text;
}

std::string list_text() {
    std::array<std::vector<Line>, groups.size()> grouped;
    for (const auto& file : shipped_files(Shipped::scene)) {
        const Scene scene = read_scene(file.path.string(), {}, {.unrun = true});
        grouped.at(group_of(scene)).push_back({file.name, cost_of(scene), scene.title});
    }
    std::string text = "Scenes, and about how long they take on one core (?: with a program "
                       "of its own);\ntvbeam run NAME runs one, tvbeam list NAME prints it.\n";
    for (std::size_t i = 0; i < groups.size(); ++i)
        text += std::string("\n") + groups.at(i) + "\n" + aligned(grouped.at(i));
    std::vector<Line> solutions;
    for (const auto& file : shipped_files(Shipped::solution)) {
        const Solution solution = read_solution(file.path);
        solutions.push_back(
            {file.name, "", solution.purpose.empty() ? solution.source : solution.purpose});
    }
    text +=
        "\nSolutions: solution = \"NAME\" in a scene, tvbeam derive NAME\n" + aligned(solutions);
    std::vector<Line> systems;
    for (const auto& file : shipped_files(Shipped::equations))
        systems.push_back({file.name, "", read_equation_system(file.path).purpose});
    text += "\nEquations with a solution: tvbeam derive NAME\n" + aligned(systems);
    return visible(text);
}

/// This program, and the files that are listed, as they are now: the first line of a catalogue.
std::string state_of_files() {
    std::string state = build_ids().front().second;
    if (state == "unknown")
        return {}; // any program's
    for (const auto kind : {Shipped::scene, Shipped::solution, Shipped::equations})
        for (const auto& [name, path] : shipped_files(kind)) {
            struct stat file {};
            if (stat(path.c_str(), &file) != 0)
                return {}; // it went just now: as no catalogue is
            state += fmt::format(" {} {} {}", name, file.st_size, file.st_mtime);
        }
    return fmt::format("{:x}", std::hash<std::string>()(state));
}

/// The list that the build made beside the program, where no file has changed since.
std::optional<std::string> kept_list() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    if (error)
        return std::nullopt;
    for (const auto& candidate :
         {program / "catalogue", program.parent_path() / "share/tvbeam/catalogue"}) {
        if (!std::filesystem::is_regular_file(candidate, error))
            continue;
        try { // what is not the build's may have the name
            const std::string text = file_text(candidate.string(), largest_shipped);
            const std::size_t end = text.find('\n');
            const std::string state = state_of_files();
            if (end != std::string::npos && !state.empty() && text.substr(0, end) == state)
                return text.substr(end + 1);
        } catch (const InputError&) {
            continue;
        }
    }
    return std::nullopt;
}

int list_command(bool to_keep) {
    if (shipped_files(Shipped::scene).empty() && shipped_files(Shipped::solution).empty())
        throw InputError({"tvbeam list"}, "the shipped scenes and solutions are not where this "
                                          "program looks for them; name their directory, which "
                                          "holds studies/scenes, in TVBEAM_DATA");
    if (to_keep)
        write_standard_output(state_of_files() + "\n" + list_text());
    else if (const auto kept = kept_list())
        write_standard_output(*kept);
    else
        write_standard_output(list_text());
    return done;
}

/// The file of a scene, or of a solution, as it stands.
int print_command(const std::string& name) {
    std::vector<std::string> names;
    for (const auto kind : {Shipped::scene, Shipped::solution, Shipped::equations})
        for (const auto& file : shipped_files(kind)) {
            if (file.name == name) {
                write_standard_output(file_text(file.path.string(), largest_shipped));
                return done;
            }
            names.push_back(file.name);
        }
    throw InputError({}, "nothing that is shipped is called '" + name + "'" +
                             did_you_mean(name, names) + "; tvbeam list shows what is");
}

InputError no_feature(const std::string& word, const FeatureTable& table) {
    std::vector<std::string> names;
    for (const auto* features : {&table.features, &table.pairs})
        for (const auto& feature : *features)
            for (const auto& part :
                 {feature.name, feature.name.substr(feature.name.rfind(' ') + 1)})
                names.push_back(part);
    return {{},
            "no feature is called '" + word + "'" + did_you_mean(word, names) +
                "; tvbeam list --features shows all"};
}

/// Those whose name holds the word, each with all its scenes; without a word a line each, with two.
int features_command(const std::string& word) {
    const FeatureTable table = feature_table();
    std::string text;
    std::string counts;
    std::size_t shown = 0;
    const auto add_line = [&](const std::string& name, const std::string& line) {
        text += wrapped(fmt::format("  {}: {}", name, line), 4);
        ++shown;
    };
    const auto add = [&](const std::string& what, const std::vector<Feature>& features) {
        text += what + ":\n";
        std::size_t used = 0;
        for (const auto& [name, scenes] : features) {
            used += scenes.empty() ? 0 : 1;
            if (name.find(word) == std::string::npos)
                continue;
            ++shown;
            const bool all = !word.empty() || scenes.size() <= 2;
            const auto named = std::span(scenes).first(all ? scenes.size() : 2);
            const std::string line =
                scenes.empty()
                    ? "none"
                    : fmt::format("{} scene{}: {}{}", scenes.size(), scenes.size() == 1 ? "" : "s",
                                  fmt::join(named, ", "), all ? "" : ", …");
            text += word.empty() ? fmt::format("  {}: {}\n", name, line)
                                 : wrapped(fmt::format("  {}: {}", name, line), 4);
        }
        text += "\n";
        counts +=
            fmt::format("{}: {} of {} in a scene with [expect]\n", what, used, features.size());
    };
    add("Features", table.features);
    add("Pairs of what a run consists of", table.pairs);
    text += "Needed in no scene:\n";
    for (const auto& [name, reason] : table.exceptions)
        if (name.find(word) != std::string::npos)
            add_line(name, reason);
    if (shown == 0)
        throw no_feature(word, table);
    write_standard_output(text + "\n" + counts);
    return done;
}

} // namespace

Command add_list(CLI::App& app) {
    auto* list =
        app.add_subcommand("list", "List the shipped scenes and solutions, or print one of them.\n"
                                   "Example: tvbeam list table1");
    struct Options {
        std::string name;
        std::string names;
        std::string word;
        bool to_keep = false;
    };
    const auto options = std::make_shared<Options>();
    auto* name =
        list->add_option("name", options->name, "print this scene or solution")->type_name("NAME");
    auto* names = list->add_option("--names", options->names,
                                   "the names alone, one a line: of all, of scenes, or of what "
                                   "tvbeam derive takes")
                      ->expected(0, 1)
                      ->check(CLI::IsMember({"all", "scenes", "derive"}))
                      ->type_name("[all|scenes|derive]")
                      ->excludes(name);
    const auto* features =
        list->add_option("--features", options->word,
                         "what scenes can use, and which of those with [expect] do, also in pairs; "
                         "with a word, those with it in their names, and all their scenes")
            ->expected(0, 1)
            ->type_name("[WORD]")
            ->excludes(name)
            ->excludes(names);
    list->add_flag("--catalogue", options->to_keep,
                   "with the state of the files, as the build keeps it")
        ->group(""); // of no use to anybody else
    return {list, [options, name, names, features] {
                if (features->count() > 0)
                    return features_command(options->word);
                if (names->count() > 0)
                    return names_command(options->names == "scenes"   ? Names::scenes
                                         : options->names == "derive" ? Names::derived
                                                                      : Names::all);
                return name->count() > 0 ? print_command(options->name)
                                         : list_command(options->to_keep);
            }};
}

} // namespace tvbeam
