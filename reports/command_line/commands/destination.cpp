#include "reports/command_line/commands/destination.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <variant>

namespace tvbeam {

namespace fs = std::filesystem;

Destination destination(const std::string& name) {
    return opened([&] { return Destination(name); });
}

bool same_place(const std::string& first, const std::string& second) {
    if (first.empty() || second.empty())
        return false;
    if (first == "-" || second == "-")
        return first == second;
    std::error_code error;
    if (fs::exists(second, error) && !fs::is_regular_file(second, error))
        return false;
    const fs::path one = fs::weakly_canonical(fs::absolute(first), error);
    if (error)
        return false;
    const fs::path other = fs::weakly_canonical(fs::absolute(second), error);
    return !error && one == other;
}

void require_apart(const std::string& first, const std::string& file, const std::string& second,
                   const std::string& other) {
    if (same_place(file, other))
        throw InputError({first + " " + file + " " + second + " " + other},
                         "two reports do not fit in one place; give one of them another");
}

void require_no_input(const std::string& option, const std::string& file,
                      const std::vector<std::string>& inputs) {
    const bool is_input = file != "-" && std::ranges::any_of(inputs, [&](const auto& input) {
                              return same_place(file, input);
                          });
    if (is_input)
        throw InputError({option + " " + file},
                         "would take the place of a file that is read; give it another");
}

std::vector<std::string> files_of(const Scene& scene) {
    std::vector<std::string> files{scene.file};
    if (const auto* solution = std::get_if<Solution>(&scene.problem);
        solution != nullptr && !solution->phases.empty())
        files.push_back(solution->phases.front().u.begin().file);
    if (scene.solver) {
        for (const auto& file : scene.solver->files)
            files.push_back(file.source.string());
        for (const auto& word : scene.solver->command)
            if (word.text.starts_with('/')) // as in `python3 /path/solve.py`
                files.push_back(word.text);
    }
    return files;
}

} // namespace tvbeam
