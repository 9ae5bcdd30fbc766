#include "studies/solution_setting.hpp"

#include "studies/scene.hpp"
#include "studies/shipped.hpp"
#include "studies/toml_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <variant>

namespace tvbeam {

namespace {

bool is_scene_file(const std::filesystem::path& file) {
    return read_toml(file.string()).table.contains("beam");
}

/// The longest time that a study of the scene runs to.
double final_time_of(const Scene& scene) {
    return std::max(scene.ladder ? scene.ladder->final_time : 0.0,
                    scene.orders ? scene.orders->final_time : 0.0);
}

SolutionSetting setting_of(const Scene& scene) {
    const auto* solution = std::get_if<Solution>(&scene.problem);
    if (solution == nullptr)
        throw InputError({scene.file},
                         "the scene has a [data] block and no exact solution to derive from");
    return {*solution, scene.beam, final_time_of(scene), "the beam of the scene " + scene.name};
}

/// The first shipped scene that runs a shipped solution.
std::optional<Scene> scene_that_runs(const Solution& solution) {
    for (const auto& file : shipped_files(Shipped::scene)) {
        Scene scene = read_scene(file.path.string());
        const auto* own = std::get_if<Solution>(&scene.problem);
        if (own != nullptr && own->name == solution.name && final_time_of(scene) > 0.0)
            return scene;
    }
    return std::nullopt;
}

/// NAME-scene.toml beside NAME.toml.
std::optional<Scene> scene_beside(const std::filesystem::path& file) {
    const auto scene = file.parent_path() / (file.stem().string() + "-scene.toml");
    if (std::error_code error; !std::filesystem::exists(scene, error))
        return std::nullopt;
    return read_scene(scene.string());
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
        return {solution, scene->beam, final_time_of(*scene),
                "the beam of the scene " + scene->name};
    constexpr double papers_final_time = 2.0;
    return {solution, Beam{0.017, 0.1, 0.0, {-0.02, 0.1}}, papers_final_time,
            "the paper's beam, as no scene names another"};
}

} // namespace tvbeam
