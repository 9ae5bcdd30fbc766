#include "studies/scene/solution_setting.hpp"

#include "mms/text/toml_reader.hpp"
#include "studies/scene/scene.hpp"
#include "studies/scene/shipped.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

namespace tvbeam {

namespace {

bool is_scene_file(const std::filesystem::path& file) {
    const auto table = read_toml(file.string()).table;
    return table.contains("beam") || table.contains("solver") ||
           std::ranges::any_of(study_kinds(),
                               [&](const auto& kind) { return table.contains(kind->name()); });
}

SolutionSetting setting_of(const Scene& scene) {
    if (scene.solver)
        throw InputError({scene.file},
                         "the scene runs a solver of its own, and has no beam to derive "
                         "from; name the file of its solution or equations");
    if (!scene.poses_problem())
        throw InputError({scene.file},
                         "[stress] poses problems of its own: there is no solution to derive "
                         "from; name a scene with another study, or a solution");
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr)
        throw InputError({scene.file},
                         "the scene has a [data] block and no exact solution to derive from");
    return {*solution, scene.beam, scene.longest_time(), "the beam of the scene " + scene.name};
}

bool names_solution(const std::filesystem::path& scene, const std::string& solution) {
    std::string text = toml_text(scene.string());
    // Most of what is shipped need not be parsed.
    return text.find(solution) != std::string::npos &&
           parse_toml(std::move(text), scene.string()).table["solution"].value<std::string>() ==
               solution;
}

/// The shipped scene that has the name of a shipped solution, or else the first that runs it.
std::optional<Scene> scene_that_runs(const Solution& solution) {
    auto scenes = shipped_files(Shipped::scene);
    std::stable_partition(scenes.begin(), scenes.end(),
                          [&](const ShippedFile& file) { return file.name == solution.name; });
    for (const auto& file : scenes)
        if (names_solution(file.path, solution.name))
            if (Scene scene = read_scene(file.path.string());
                scene.poses_problem() && !scene.solver)
                return scene;
    return std::nullopt;
}

/// Whether a scene runs the solution of that file.
bool runs(const Scene& scene, const std::filesystem::path& file) {
    const auto* own = std::get_if<Solution>(&scene.problem);
    std::error_code error;
    return own != nullptr && !own->phases.empty() &&
           std::filesystem::equivalent(own->phases.front().theta.begin().file, file, error);
}

/// The first scene, by name, that lies beside a solution and runs it.
std::optional<Scene> scene_beside(const std::filesystem::path& file) {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    std::set<std::filesystem::path> beside;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml")
            beside.insert(entry.path());
    for (const auto& path : beside)
        try {
            if (!is_scene_file(path))
                continue;
            if (Scene scene = read_scene(path.string()); runs(scene, file))
                return scene;
        } catch (const InputError&) {
            continue; // whoever runs that scene is told what is wrong with it
        }
    return std::nullopt;
}

} // namespace

SolutionSetting solution_setting(const std::string& name) {
    const bool is_file = name.find('/') != std::string::npos || name.ends_with(".toml");
    const auto scenes = shipped_files(Shipped::scene);
    const bool is_shipped_scene = std::any_of(
        scenes.begin(), scenes.end(), [&](const ShippedFile& file) { return file.name == name; });
    if (is_shipped_scene || (is_file && is_scene_file(find_file(Shipped::scene, name))))
        return setting_of(read_scene(name));

    const std::filesystem::path file = find_file(Shipped::solution, name);
    const Solution solution = read_solution(file);
    if (const auto scene = is_file ? scene_beside(file) : scene_that_runs(solution))
        return {solution, scene->beam, scene->longest_time(),
                "the beam of the scene " + scene->name};
    constexpr double papers_final_time = 2.0;
    return {solution, Beam{0.017, 0.1, 0.0, {-0.02, 0.1}}, papers_final_time,
            "the paper's beam, as no scene names another"};
}

} // namespace tvbeam
