#include "mms/equations/equation_system.hpp"
#include "mms/text/input_error.hpp"
#include "reports/command_line/commands/command.hpp"
#include "reports/document/text_table.hpp"
#include "reports/document/visible_text.hpp"
#include "reports/files/output_file.hpp"
#include "studies/gates/features.hpp"
#include "studies/scene/shipped.hpp"
#include "studies/study.hpp"

#include <fmt/ranges.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tvbeam {

namespace {

int names_command() {
    std::string text;
    for (const auto kind : {Shipped::scene, Shipped::solution, Shipped::equations})
        for (const auto& file : shipped_files(kind))
            text += file.name + "\n";
    write_standard_output(text);
    return done;
}

int list_command() {
    if (shipped_files(Shipped::scene).empty() && shipped_files(Shipped::solution).empty())
        throw InputError({"tvbeam list"}, "the shipped scenes and solutions are not where this "
                                          "program looks for them; name their directory, which "
                                          "holds studies/scenes, in TVBEAM_DATA");
    std::string text = "Scenes (tvbeam run NAME):\n";
    for (const auto& file : shipped_files(Shipped::scene))
        text += wrapped("  " + file.name + ": " + read_scene(file.path.string()).title, 4);
    text += "\nSolutions (solution = \"NAME\" in a scene, tvbeam derive NAME):\n";
    for (const auto& file : shipped_files(Shipped::solution)) {
        const Solution solution = read_solution(file.path);
        text += wrapped("  " + file.name + ": " +
                            (solution.purpose.empty() ? solution.source : solution.purpose),
                        4);
    }
    text += "\nEquations with a solution (tvbeam derive NAME):\n";
    for (const auto& file : shipped_files(Shipped::equations))
        text += wrapped("  " + file.name + ": " + read_equation_system(file.path).purpose, 4);
    write_standard_output(visible(text));
    return done;
}

/// Those whose name holds the word, each with all its scenes; without a word a line each, with two.
int features_command(const std::string& word) {
    const FeatureTable table = feature_table();
    std::string text;
    std::string counts;
    const auto add = [&](const std::string& what, const std::vector<Feature>& features) {
        text += what + ":\n";
        std::size_t used = 0;
        for (const auto& [name, scenes] : features) {
            used += scenes.empty() ? 0 : 1;
            if (name.find(word) == std::string::npos)
                continue;
            const bool all = !word.empty() || scenes.size() <= 2;
            const auto shown = std::span(scenes).first(all ? scenes.size() : 2);
            const std::string line =
                scenes.empty()
                    ? "none"
                    : fmt::format("{} scene{}: {}{}", scenes.size(), scenes.size() == 1 ? "" : "s",
                                  fmt::join(shown, ", "), all ? "" : ", …");
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
        text += wrapped(fmt::format("  {}: {}", name, reason), 4);
    write_standard_output(text + "\n" + counts);
    return done;
}

} // namespace

Command add_list(CLI::App& app) {
    auto* list = app.add_subcommand(
        "list", "List the shipped scenes, solutions and equations.\nExample: tvbeam list");
    const auto names = std::make_shared<bool>(false);
    const auto word = std::make_shared<std::string>();
    list->add_flag("--names", *names, "the names alone, one a line");
    const auto* features =
        list->add_option("--features", *word,
                         "what scenes can use, and which of those with [expect] do, also in pairs; "
                         "with a word, those with it in their names, and all their scenes")
            ->expected(0, 1)
            ->type_name("[WORD]")
            ->excludes("--names");
    return {list, [names, word, features] {
                return features->count() > 0 ? features_command(*word)
                       : *names              ? names_command()
                                             : list_command();
            }};
}

} // namespace tvbeam
